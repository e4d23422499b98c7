// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/occupancy_grid.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {

OccupancyGrid::OccupancyGrid(const Eigen::Vector2d& origin_m, double cell_size_m, int width,
                             int height, Occupancy fill)
    : cell_size_m_(cell_size_m), width_(width), height_(height) {
  setOrigin(origin_m);
  if (!(cell_size_m > 0.0) || !std::isfinite(cell_size_m)) {
    throw std::invalid_argument("a grid's cell size must be positive");
  }
  if (width <= 0 || height <= 0) throw std::invalid_argument("a grid must have cells");
  cells_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
}

void OccupancyGrid::setOrigin(const Eigen::Vector2d& origin_m) {
  if (!origin_m.allFinite()) throw std::invalid_argument("a grid's origin must be finite");
  origin_m_ = origin_m;
}

GridCell OccupancyGrid::cellAt(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d cell = (point - origin_m_) / cell_size_m_;
  return {static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y()))};
}

Occupancy OccupancyGrid::at(const Eigen::Vector2d& point) const {
  const GridCell cell = cellAt(point);
  return contains(cell) ? at(cell) : Occupancy::kUnknown;
}

}  // namespace heel
