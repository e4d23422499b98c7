// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_score.hpp>
#include <heel/segmentation/hsv.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace heel {

ColorScore hueSaturationScore(const ColorHistogram& person, const HueSaturationParams& params) {
  if (!isBinCount(params.hue_bins) || !isBinCount(params.saturation_bins)) {
    throw std::invalid_argument("hue and saturation need 1 to 256 bins");
  }
  if (person.empty()) throw std::invalid_argument("there are no colours of the person");
  const auto hues = static_cast<std::size_t>(params.hue_bins);
  const auto saturations = static_cast<std::size_t>(params.saturation_bins);
  std::vector<double> shares(hues * saturations, 0.0);
  person.forEach([&](Bgr c, std::uint64_t count) {
    const Hsv hsv = toHsv(c.b, c.g, c.r);
    shares[hsvBin(hsv.hue, hues) * saturations + hsvBin(hsv.saturation, saturations)] +=
        static_cast<double>(count) / static_cast<double>(person.total());
  });
  // Weights 1, 2, 1 along both axes: hues go round, saturations end.
  auto smooth = std::make_shared<std::vector<double>>(shares.size(), 0.0);
  for (std::size_t h = 0; h < hues; ++h) {
    for (std::size_t s = 0; s < saturations; ++s) {
      for (int step = 0; step < 9; ++step) {
        const int dh = step / 3 - 1, ds = step % 3 - 1;
        const std::size_t to_h = (h + hues + static_cast<std::size_t>(step / 3) - 1) % hues;
        const int to_s = std::clamp(static_cast<int>(s) + ds, 0, params.saturation_bins - 1);
        (*smooth)[to_h * saturations + static_cast<std::size_t>(to_s)] +=
            shares[h * saturations + s] * (dh == 0 ? 0.5 : 0.25) * (ds == 0 ? 0.5 : 0.25);
      }
    }
  }
  return [smooth, hues, saturations](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const Hsv hsv = toHsv(b, g, r);
    return (*smooth)[hsvBin(hsv.hue, hues) * saturations + hsvBin(hsv.saturation, saturations)];
  };
}

}  // namespace heel
