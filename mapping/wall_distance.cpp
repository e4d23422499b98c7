// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/wall_distance.hpp>

#include <dynamicEDT3D/dynamicEDT3D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

WallDistance::WallDistance(const OccupancyGrid& grid, double max_m) : grid_(grid), max_m_(max_m) {
  if (grid.empty()) return;
  // Distances are found from cell to cell and given from a place in one to the edge of another.
  const double max_cells = std::ceil(max_m / grid.cell_size_m()) + 1.0;
  if (!(max_m >= grid.cell_size_m()) || !(max_cells < 30000.0)) {
    throw std::invalid_argument("WallDistance: the largest distance must be at least a cell");
  }
  // One layer; the rows are its second axis, so that a row lies in one piece of memory.
  DynamicEDT3D field(static_cast<int>(max_cells * max_cells));
  field.initializeEmpty(1, grid.height(), grid.width());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (grid.at(GridCell{x, y}) == Occupancy::kOccupied) field.occupyCell(0, y, x);
    }
  }
  field.update(false);
  nearest_.resize(grid.cells().size(), GridCell{-1, -1});
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const INTPOINT3D wall = field.getClosestObstacle(0, y, x);
      if (wall.x == DynamicEDT3D::invalidObstData) continue;
      nearest_[grid.index({x, y})] = {wall.z, wall.y};
    }
  }
}

double WallDistance::at(const Eigen::Vector2d& place) const {
  if (nearest_.empty() || !place.allFinite()) return max_m_;
  const Eigen::Vector2d cell = (place - grid_.origin_m()) / grid_.cell_size_m();
  if (cell.minCoeff() < 0.0 || cell.x() >= grid_.width() || cell.y() >= grid_.height()) {
    return max_m_;
  }
  // The wall nearest to a cell's middle need not be that of each of its points: ask those about it.
  const GridCell home = grid_.cellAt(place);
  double least_m = max_m_;
  for (int y = home.y - 1; y <= home.y + 1; ++y) {
    for (int x = home.x - 1; x <= home.x + 1; ++x) {
      if (!grid_.contains({x, y})) continue;
      const GridCell& wall = nearest_[grid_.index({x, y})];
      if (wall.x < 0) continue;
      const Eigen::Vector2d beyond = (place - grid_.center(wall)).cwiseAbs() -
                                     Eigen::Vector2d::Constant(grid_.cell_size_m() / 2.0);
      least_m = std::min(least_m, beyond.cwiseMax(0.0).norm());
    }
  }
  return least_m;
}

}  // namespace heel
