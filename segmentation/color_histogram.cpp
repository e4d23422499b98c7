// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_histogram.hpp>

#include <array>

namespace heel {

void ColorHistogram::merge(const ColorHistogram& other) {
  for (std::size_t cell = 0; cell < counts_.size(); ++cell) counts_[cell] += other.counts_[cell];
  total_ += other.total_;
}

Bgr ColorHistogram::middleOf(std::size_t cell) {
  static const auto middles = [] {
    std::array<std::uint8_t, ColorTable::kLevels> values{};
    for (int v = 0; v < 256; ++v) {
      const auto value = static_cast<std::uint8_t>(v);
      values[ColorTable::cell(value, 0, 0)] = ColorTable::middle(value);
    }
    return values;
  }();
  constexpr std::size_t kLevels = ColorTable::kLevels;
  return {middles[cell % kLevels], middles[cell / kLevels % kLevels],
          middles[cell / (kLevels * kLevels)]};
}

}  // namespace heel
