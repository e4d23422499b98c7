// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The colours of a person between two heights: what every appearance model ends as.
#pragma once

#include "segmentation/color_table.hpp"

#include <vector>

namespace heel {

/// Colours that a person has between two heights over the floor [m].
struct AppearanceBand {
  double min_height_m = 1.0;
  double max_height_m = 2.2;
  ColorTable table;
};

/// The bands of one person, which do not overlap; one band from 1 m up is the paper's.
using AppearanceBands = std::vector<AppearanceBand>;

/// A table that passes whatever one of the bands passes, for pixels whose height is not known yet.
/// @throws std::invalid_argument  if there is no band.
ColorTable anyBand(const AppearanceBands& bands);

}  // namespace heel
