// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A function of colour alone, tabulated: what the paper's look-up tables are (section 3.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace heel {

/// Scores in [0, 255] for every colour, quantised to `kBits` bits a channel.
///
/// A colour (b, g, r) falls in the cell (b >> kShift, g >> kShift, r >> kShift); the cell holds the
/// value of the tabulated function at its centre colour. The table is immutable once made.
class ColorTable {
 public:
  static constexpr int kBits = 6;
  static constexpr int kShift = 8 - kBits;
  static constexpr std::size_t kCells = std::size_t{1} << (3 * kBits);

  /// A table that scores every colour 0.
  ColorTable();

  /// Tabulates `score(b, g, r)`, called once for the centre of each cell.
  explicit ColorTable(
      const std::function<std::uint8_t(std::uint8_t, std::uint8_t, std::uint8_t)>& score);

  static constexpr std::size_t cell(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return (static_cast<std::size_t>(b >> kShift) << (2 * kBits)) |
           (static_cast<std::size_t>(g >> kShift) << kBits) | static_cast<std::size_t>(r >> kShift);
  }

  std::uint8_t operator()(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return scores_[cell(b, g, r)];
  }

  const std::uint8_t* data() const { return scores_.data(); }

 private:
  std::vector<std::uint8_t> scores_;
};

}  // namespace heel
