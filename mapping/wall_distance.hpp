// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far it is from any place on the floor to the nearest wall.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <vector>

namespace heel {

/// The nearest wall of every cell of a floor grid, found once by dynamicEDT3D. Queries may be asked
/// from many threads at once.
class WallDistance {
 public:
  /// @param grid   Only its occupied cells are walls; what is unknown is not.
  /// @param max_m  Walls further away than this are not looked for.
  /// @throws std::invalid_argument  unless `max_m` is at least a cell and finite.
  explicit WallDistance(const OccupancyGrid& grid, double max_m = 3.0);

  /// Distance to the nearest wall's cell [m]; 0 inside it; max_m() where none is nearer, and
  /// outside the grid.
  double at(const Eigen::Vector2d& place) const;

  double max_m() const { return max_m_; }

 private:
  OccupancyGrid grid_;
  double max_m_;
  std::vector<GridCell> nearest_;  ///< Of each cell of the grid; x = -1: none.
};

}  // namespace heel
