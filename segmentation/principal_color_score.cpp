// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_histogram.hpp>
#include <heel/segmentation/color_score.hpp>
#include <heel/segmentation/hsv.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

/// The paper's A = <D_H, D_V>.
struct PrincipalColor {
  std::vector<double> hue_shares;
  std::vector<double> value_shares;

  double operator()(const Hsv& c) const {
    return c.saturation * hue_shares[hsvBin(c.hue, hue_shares.size())] +
           (1.0 - c.saturation) * value_shares[hsvBin(c.value, value_shares.size())];
  }
};

PrincipalColor makePrincipalColor(const ColorHistogram& points,
                                  const PrincipalColorParams& params) {
  PrincipalColor color{std::vector<double>(static_cast<std::size_t>(params.hue_bins), 0.0),
                       std::vector<double>(static_cast<std::size_t>(params.value_bins), 0.0)};
  const auto total = static_cast<double>(points.total());
  points.forEach([&](Bgr c, std::uint64_t count) {
    const Hsv hsv = toHsv(c.b, c.g, c.r);
    const double share = static_cast<double>(count) / total;
    color.hue_shares[hsvBin(hsv.hue, color.hue_shares.size())] += share;
    color.value_shares[hsvBin(hsv.value, color.value_shares.size())] += share;
  });
  return color;
}

}  // namespace

ColorScore principalColorScore(const ColorHistogram& person, const PrincipalColorParams& params) {
  if ((params.count != 0 && !isBinCount(params.count)) || !isBinCount(params.max_count)) {
    throw std::invalid_argument("the number of principal colours must be 0 to 256");
  }
  if (!isBinCount(params.hue_bins) || !isBinCount(params.value_bins)) {
    throw std::invalid_argument("hue and value need 1 to 256 bins");
  }
  const auto parts = params.count == 0
                         ? clusterColorsFromData(person, params.max_count, params.min_spread_drop)
                         : clusterColors(person, params.count);
  auto colors = std::make_shared<std::vector<PrincipalColor>>();
  for (const ColorHistogram& cluster : parts.clusters) {
    colors->push_back(makePrincipalColor(cluster, params));
  }
  return [colors](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const Hsv hsv = toHsv(b, g, r);
    double best = 0.0;
    for (const PrincipalColor& color : *colors) best = std::max(best, color(hsv));
    return best;
  };
}

}  // namespace heel
