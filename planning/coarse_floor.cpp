// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/coarse_floor.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {

CoarseFloor::CoarseFloor(OccupancyGrid map, double cell_size_m, double body_radius_m,
                         std::optional<OccupancyGrid> sight)
    : map_(std::move(map)), sight_(sight ? std::move(*sight) : map_), cell_size_m_(cell_size_m) {
  if (map_.empty()) throw std::invalid_argument("a floor needs a map");
  if (!(cell_size_m > 0.0)) throw std::invalid_argument("cells must have a size");
  if (!(body_radius_m >= 0.5 * cell_size_m)) {
    throw std::invalid_argument("a body must be as wide as a cell");
  }
  const auto count = [&](int cells) {
    return static_cast<int>(std::ceil(cells * map_.cell_size_m() / cell_size_m - 1e-9));
  };
  width_ = count(map_.width());
  height_ = count(map_.height());
  is_free_.resize(static_cast<std::size_t>(cells()));
  for (int c = 0; c < cells(); ++c) {
    is_free_[static_cast<std::size_t>(c)] = isClear(center(c), body_radius_m) ? 1 : 0;
  }
  neighbours_.assign(is_free_.size() * 8, -1);
  const auto freeAt = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && isFree(y * width_ + x);
  };
  for (int c = 0; c < cells(); ++c) {
    if (!isFree(c)) continue;
    const int x = c % width_, y = c / width_;
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      const int nx = x + kWays[way][0], ny = y + kWays[way][1];
      if (!freeAt(nx, ny) || !freeAt(nx, y) || !freeAt(x, ny)) continue;
      neighbours_[static_cast<std::size_t>(c) * 8 + way] = ny * width_ + nx;
    }
  }
}

Eigen::Vector2d CoarseFloor::center(int cell) const {
  return map_.origin_m() + cell_size_m_ * Eigen::Vector2d(cell % width_ + 0.5, cell / width_ + 0.5);
}

int CoarseFloor::cellAt(const Eigen::Vector2d& point) const {
  const Eigen::Array2d at = ((point - map_.origin_m()) / cell_size_m_).array().floor();
  const bool is_inside = (at >= 0.0).all() && at.x() < width_ && at.y() < height_;
  return is_inside ? static_cast<int>(at.y()) * width_ + static_cast<int>(at.x()) : -1;
}

int CoarseFloor::nearestFree(const Eigen::Vector2d& point) const {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int c = 0; c < cells(); ++c) {
    const double distance = (center(c) - point).squaredNorm();
    if (!isFree(c) || !(distance < least)) continue;
    least = distance;
    nearest = c;
  }
  return nearest;
}

bool CoarseFloor::isClear(const Eigen::Vector2d& point, double radius_m) const {
  const double radius = radius_m - 1e-9;  // what only touches does not bar
  const double half = 0.5 * map_.cell_size_m();
  const GridCell low = map_.cellAt(point - Eigen::Vector2d::Constant(radius));
  const GridCell high = map_.cellAt(point + Eigen::Vector2d::Constant(radius));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const GridCell cell{x, y};
      if (map_.contains(cell) && map_.at(cell) == Occupancy::kFree) continue;
      const Eigen::Array2d away = (map_.center(cell) - point).array().abs() - half;
      if (away.max(0.0).matrix().squaredNorm() < radius * radius) return false;
    }
  }
  return true;
}

bool CoarseFloor::sees(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  // From cell to cell along the line (Amanatides and Woo).
  GridCell cell = sight_.cellAt(from);
  const GridCell last = sight_.cellAt(to);
  const Eigen::Vector2d way = (to - from) / sight_.cell_size_m();
  const Eigen::Vector2d start = (from - sight_.origin_m()) / sight_.cell_size_m();
  const int step_x = way.x() > 0.0 ? 1 : -1, step_y = way.y() > 0.0 ? 1 : -1;
  const auto crossing = [](double at, int index, int step, double speed) {
    if (speed == 0.0) return std::numeric_limits<double>::infinity();
    return ((step > 0 ? index + 1 : index) - at) / speed;
  };
  double next_x = crossing(start.x(), cell.x, step_x, way.x());
  double next_y = crossing(start.y(), cell.y, step_y, way.y());
  const double each_x = 1.0 / std::abs(way.x()), each_y = 1.0 / std::abs(way.y());
  int left = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  for (; left >= 0; --left) {
    if (!sight_.contains(cell) || sight_.at(cell) != Occupancy::kFree) return false;
    if (next_x < next_y) {
      cell.x += step_x;
      next_x += each_x;
    } else {
      cell.y += step_y;
      next_y += each_y;
    }
  }
  return true;
}

void CoarseFloor::walkingDistances(int from, std::vector<float>& distance_m, Open& open,
                                   FunctionRef<bool(int cell)> is_open) const {
  distance_m.assign(is_free_.size(), std::numeric_limits<float>::infinity());
  open.clear();
  if (from < 0 || from >= cells() || !isFree(from)) return;
  const auto later = std::greater<std::pair<float, int>>();
  distance_m[static_cast<std::size_t>(from)] = 0.0F;
  open.emplace_back(0.0F, from);
  while (!open.empty()) {
    std::pop_heap(open.begin(), open.end(), later);
    const auto [distance, cell] = open.back();
    open.pop_back();
    if (distance > distance_m[static_cast<std::size_t>(cell)]) continue;
    for (int way = 0; way < 8; ++way) {
      const int next = neighbour(cell, way);
      if (next < 0) continue;
      const double step = (way % 2 == 0 ? 1.0 : std::sqrt(2.0)) * cell_size_m_;
      const float through = distance + static_cast<float>(step);
      float& known = distance_m[static_cast<std::size_t>(next)];
      if (through >= known || !is_open(next)) continue;
      known = through;
      open.emplace_back(through, next);
      std::push_heap(open.begin(), open.end(), later);
    }
  }
}

}  // namespace heel
