// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_table.hpp>

#include <utility>

namespace heel {
namespace {

/// The middle colours of all levels, in the order of the levels.
std::array<std::uint8_t, ColorTable::kLevels> middles() {
  std::array<std::uint8_t, ColorTable::kLevels> values{};
  for (int v = 0; v < 256; ++v) {
    const auto value = static_cast<std::uint8_t>(v);
    values[ColorTable::cell(value, 0, 0)] = ColorTable::middle(value);
  }
  return values;
}

}  // namespace

ColorTable::ColorTable(const Score& score, std::uint8_t threshold) : threshold_(threshold) {
  const auto values = middles();
  std::vector<std::uint8_t> scores;
  scores.reserve(kCells);
  for (const std::uint8_t r : values) {
    for (const std::uint8_t g : values) {
      for (const std::uint8_t b : values) scores.push_back(score(b, g, r));
    }
  }
  scores_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(scores));
}

ColorTable ColorTable::withThreshold(std::uint8_t threshold) const {
  ColorTable table = *this;
  table.threshold_ = threshold;
  return table;
}

}  // namespace heel
