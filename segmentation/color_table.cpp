// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/color_table.hpp"

namespace heel {

ColorTable::ColorTable() : scores_(kCells, 0) {}

ColorTable::ColorTable(
    const std::function<std::uint8_t(std::uint8_t, std::uint8_t, std::uint8_t)>& score)
    : scores_(kCells) {
  constexpr int kSteps = 1 << kBits;
  const auto centre = [](int step) {
    return static_cast<std::uint8_t>((step << kShift) + (1 << kShift) / 2);
  };
  std::size_t i = 0;
  for (int b = 0; b < kSteps; ++b) {
    for (int g = 0; g < kSteps; ++g) {
      for (int r = 0; r < kSteps; ++r) {
        scores_[i++] = score(centre(b), centre(g), centre(r));
      }
    }
  }
}

}  // namespace heel
