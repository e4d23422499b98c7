// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A map of cells as the outline of a drawing.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Geometry>

#include <string>

namespace heel {

/// The part of the grid in which something is known that is not free all around: all occupied
/// cells. Empty if there are none.
Eigen::AlignedBox2d occupiedBounds(const OccupancyGrid& grid);

/// The edges between the cells that are `what` and all others, as a closed path of SVG in metres,
/// with y down from `top_left`; to be filled by the even-odd rule. Straight runs are one step, so
/// the path's size follows the number of corners and not of cells.
std::string outlinePath(const OccupancyGrid& grid, Occupancy what,
                        const Eigen::Vector2d& top_left_m);

}  // namespace heel
