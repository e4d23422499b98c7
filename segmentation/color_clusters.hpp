// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which principal colours a person wears.
#pragma once

#include <heel/segmentation/color_histogram.hpp>

#include <vector>

namespace heel {

/// Colours in groups, and how far they lie from their groups' middles.
struct ColorClusters {
  std::vector<ColorHistogram> clusters;  ///< Biggest first; empty groups are left out.
  double spread = 0.0;  ///< Mean squared distance to the group's middle, in log colour space.
};

/// Parts `colors` into at most `count` groups by k-means on the logarithms of the channels.
///
/// Deterministic: starts from the colours that lie furthest from each other, weighed by how often
/// they were seen.
/// @throws std::invalid_argument  if `count` is not positive or `colors` is empty.
ColorClusters clusterColors(const ColorHistogram& colors, int count);

/// The greatest number of groups, up to `max_count`, of which each took away at least the share
/// `min_spread_drop` of the spread that was left before it.
ColorClusters clusterColorsFromData(const ColorHistogram& colors, int max_count,
                                    double min_spread_drop);

}  // namespace heel
