// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Floor plans as pictures and in words.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <string>

namespace heel {

/// The plan from above, x to the right, with a line of text over it and a scale under it; CV_8UC3
/// of about `size_px` on its longer side.
/// @throws std::invalid_argument  if the grid is empty.
cv::Mat drawMap(const OccupancyGrid& grid, const std::string& title, int size_px = 1000);

/// "8.0 x 6.0 m in cells of 0.05 m: 30.2 m2 free, 4.1 m2 walls, 13.7 m2 unknown".
std::string toText(const OccupancyGrid& grid);

/// The part of the grid in which something is known that is not free all around: all occupied
/// cells. Empty if there are none.
Eigen::AlignedBox2d occupiedBounds(const OccupancyGrid& grid);

/// The edges between the cells that are `what` and all others, as a closed path of SVG in metres,
/// with y down from `top_left`; to be filled by the even-odd rule. Straight runs are one step, so
/// the path's size follows the number of corners and not of cells.
std::string outlinePath(const OccupancyGrid& grid, Occupancy what,
                        const Eigen::Vector2d& top_left_m);

}  // namespace heel
