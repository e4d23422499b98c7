// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How often each colour was seen, all that phase 1 keeps of the person and of the room, and the
/// groups that these colours form.
#pragma once

#include <heel/segmentation/color_table.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

/// An 8-bit colour.
struct Bgr {
  std::uint8_t b = 0;
  std::uint8_t g = 0;
  std::uint8_t r = 0;
};

/// Counts of colours on the cells of a ColorTable.
///
/// A ColorTable answers alike for all colours of a cell, so whatever is counted here about a table
/// (how many of these pixels does it pass?) is exact, not an estimate.
class ColorHistogram {
 public:
  ColorHistogram() : counts_(ColorTable::kCells, 0) {}

  /// Counts one pixel.
  void add(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    ++counts_[ColorTable::cell(b, g, r)];
    ++total_;
  }

  /// Counts `count` pixels of a colour.
  void add(Bgr color, std::uint64_t count) {
    counts_[ColorTable::cell(color.b, color.g, color.r)] += count;
    total_ += count;
  }

  /// Adds everything that `other` counted.
  void merge(const ColorHistogram& other);

  std::uint64_t total() const { return total_; }
  bool empty() const { return total_ == 0; }

  /// How many pixels fell in the cell of a colour.
  std::uint64_t operator()(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return counts_[ColorTable::cell(b, g, r)];
  }

  /// Calls `visit(color, count)` for each cell that is not empty, in order of the cells; `color` is
  /// the cell's middle colour.
  template <typename Visitor>
  void forEach(const Visitor& visit) const {
    for (std::size_t cell = 0; cell < counts_.size(); ++cell) {
      if (counts_[cell] != 0) visit(middleOf(cell), counts_[cell]);
    }
  }

 private:
  static Bgr middleOf(std::size_t cell);

  std::vector<std::uint64_t> counts_;
  std::uint64_t total_ = 0;
};

/// Colours in groups, and how far they lie from their groups' middles.
struct ColorClusters {
  std::vector<ColorHistogram> clusters;  ///< Biggest first; empty groups are left out.
  double spread = 0.0;  ///< Mean squared distance to the group's middle, in log colour space.
};

/// Parts `colors` into at most `count` groups by k-means on the logarithms of the channels.
///
/// Deterministic: starts from their mean and the colours that lie furthest from it and each other,
/// weighed by how often they were seen.
/// @throws std::invalid_argument  if `count` is not positive or `colors` is empty.
ColorClusters clusterColors(const ColorHistogram& colors, int count);

/// As clusterColors(), with the greatest number of groups, up to `max_count`, of which each took
/// away at least the share `min_spread_drop` of the spread that was left before it.
ColorClusters clusterColorsFromData(const ColorHistogram& colors, int max_count,
                                    double min_spread_drop);

}  // namespace heel
