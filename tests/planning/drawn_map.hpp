// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Drawn maps, and the shortest ways on them by brute force: nothing here uses the grid's code.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/path.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

namespace heel::test {

/// A rectangle of blocked floor [m].
struct Box {
  Eigen::Vector2d low, high;
};

/// A floor from (0, 0) to `size` with boxes on it, whose sides lie on the cells' sides.
struct DrawnMap {
  Eigen::Vector2d size;
  double cell_size_m = 0.05;
  std::vector<Box> boxes;

  OccupancyGrid grid() const {
    const Eigen::Vector2i cells = (size / cell_size_m).array().round().cast<int>();
    OccupancyGrid grid({0, 0}, cell_size_m, cells.x(), cells.y());
    for (const Box& box : boxes) {
      const Eigen::Vector2i low = (box.low / cell_size_m).array().round().cast<int>();
      const Eigen::Vector2i high = (box.high / cell_size_m).array().round().cast<int>();
      for (int y = std::max(0, low.y()); y < std::min(cells.y(), high.y()); ++y) {
        for (int x = std::max(0, low.x()); x < std::min(cells.x(), high.x()); ++x) {
          grid.at(GridCell{x, y}) = Occupancy::kOccupied;
        }
      }
    }
    return grid;
  }
};

/// A floor with so many boxes of random places and sizes.
inline DrawnMap randomMap(std::mt19937& random, int boxes, double side_m = 8.0,
                          double cell_size_m = 0.05) {
  DrawnMap map{{side_m, side_m}, cell_size_m, {}};
  const auto draw = [&](double low, double high) {
    const double v = std::uniform_real_distribution<double>(low, high)(random);
    return std::round(v / cell_size_m) * cell_size_m;
  };
  for (int i = 0; i < boxes; ++i) {
    const Eigen::Vector2d low(draw(0, side_m), draw(0, side_m));
    const bool is_wall = i % 3 == 0;
    const Eigen::Vector2d size =
        is_wall ? (i % 2 == 0 ? Eigen::Vector2d(draw(1, 3), 0.1) : Eigen::Vector2d(0.1, draw(1, 3)))
                : Eigen::Vector2d(draw(0.1, 1.2), draw(0.1, 1.2));
    map.boxes.push_back({low, (low + size).cwiseMin(side_m)});
  }
  return map;
}

inline double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double norm = along.squaredNorm();
  const double t = norm > 0.0 ? std::clamp((p - a).dot(along) / norm, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

inline double distanceTo(const Box& box, const Eigen::Vector2d& p) {
  return (p - p.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

/// Whether the segment goes through the box's inside (slabs).
inline bool crosses(const Box& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double from = 0.0, to = 1.0;
  for (int k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    if (std::abs(d) < 1e-12) {
      if (a[k] <= box.low[k] || a[k] >= box.high[k]) return false;
      continue;
    }
    const double t0 = (box.low[k] - a[k]) / d, t1 = (box.high[k] - a[k]) / d;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from < to;
}

inline double distanceTo(const Box& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  if (crosses(box, a, b)) return 0.0;
  double least = std::min(distanceTo(box, a), distanceTo(box, b));
  for (const Eigen::Vector2d& corner :
       {box.low, box.high, Eigen::Vector2d(box.low.x(), box.high.y()),
        Eigen::Vector2d(box.high.x(), box.low.y())}) {
    least = std::min(least, distanceToSegment(corner, a, b));
  }
  return least;
}

/// Distance of a segment to the nearest box and to the border.
inline double clearanceOf(const DrawnMap& map, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d low = a.cwiseMin(b), high = map.size - a.cwiseMax(b);
  double least = std::max(0.0, std::min(low.minCoeff(), high.minCoeff()));
  for (const Box& box : map.boxes) least = std::min(least, distanceTo(box, a, b));
  return least;
}

/// Length of the shortest way of a disc between two points, by a visibility graph over points
/// around all corners; some thousandths too long where it bends. Infinite if there is none.
inline double shortestWay(const DrawnMap& map, double radius_m, const Eigen::Vector2d& start,
                          const Eigen::Vector2d& goal) {
  constexpr int kSteps = 8;  // Of a corner's quarter circle.
  constexpr double kQuarter = 1.57079632679489662, kHair = 1e-9;
  const double reach = (radius_m + 2 * kHair) / std::cos(kQuarter / kSteps / 2);
  FloorPath nodes = {start, goal};
  for (const Box& box : map.boxes) {
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d corner(k == 0 || k == 3 ? box.high.x() : box.low.x(),
                                   k < 2 ? box.high.y() : box.low.y());
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = kQuarter * (k + double(i) / kSteps);
        const Eigen::Vector2d at =
            corner + reach * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        if (clearanceOf(map, at, at) >= radius_m - kHair) nodes.push_back(at);
      }
    }
  }
  std::vector<double> cost(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(nodes.size(), false);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[0] = 0.0;
  open.push({(goal - start).norm(), 0});
  while (!open.empty()) {
    const std::size_t at = open.top().second;
    open.pop();
    if (at == 1) return cost[1];
    if (done[at]) continue;
    done[at] = true;
    for (std::size_t to = 1; to < nodes.size(); ++to) {
      const double through = cost[at] + (nodes[to] - nodes[at]).norm();
      if (done[to] || through >= cost[to]) continue;
      if (clearanceOf(map, nodes[at], nodes[to]) < radius_m - kHair) continue;
      cost[to] = through;
      open.push({through + (goal - nodes[to]).norm(), to});
    }
  }
  return std::numeric_limits<double>::infinity();
}

/// A point at which a disc is clear.
inline Eigen::Vector2d randomPlace(std::mt19937& random, const DrawnMap& map, double radius_m) {
  std::uniform_real_distribution<double> x(0.0, map.size.x()), y(0.0, map.size.y());
  while (true) {
    const Eigen::Vector2d p(x(random), y(random));
    if (clearanceOf(map, p, p) >= radius_m) return p;
  }
}

}  // namespace heel::test
