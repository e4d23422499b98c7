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
  // What is no number, or too far away for an int, is outside.
  constexpr double kFar = 1e9;
  const auto index = [](double cells) {
    return static_cast<int>(std::floor(std::fmax(-kFar, std::fmin(kFar, cells))));
  };
  const Eigen::Vector2d cell = (point - origin_m_) / cell_size_m_;
  return {index(cell.x()), index(cell.y())};
}

Occupancy OccupancyGrid::at(const Eigen::Vector2d& point) const {
  const GridCell cell = cellAt(point);
  return contains(cell) ? at(cell) : Occupancy::kUnknown;
}

bool OccupancyGrid::isOccupiedWithin(const Eigen::Vector2d& point, double radius_m) const {
  const Eigen::Array2d p = (point - origin_m_) / cell_size_m_;
  const double radius = radius_m / cell_size_m_;
  const Eigen::Array2d size(width_, height_);
  // Not of what is far outside, nor of what is no number: neither is an index.
  if (!((p + radius >= 0.0).all() && (p - radius <= size).all())) return false;
  const Eigen::Array2i low = (p - radius).floor().max(0.0).cast<int>();
  const Eigen::Array2i high = (p + radius).min(size - 1.0).cast<int>();
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      if (at(GridCell{x, y}) != Occupancy::kOccupied) continue;
      const Eigen::Array2d corner(x, y);
      const Eigen::Array2d nearest = p.max(corner).min(corner + 1.0);
      if ((p - nearest).matrix().norm() <= radius) return true;
    }
  }
  return false;
}

}  // namespace heel
