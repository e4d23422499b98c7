// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Rooms drawn as grids, and scans of them.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <cmath>
#include <limits>

namespace heel::test {

constexpr double kPi = 3.14159265358979323846;

/// Occupied cells over a rectangle, or others.
inline void drawBlock(OccupancyGrid& grid, double x0, double y0, double x1, double y1,
                      Occupancy what = Occupancy::kOccupied) {
  for (GridCell c; c.y < grid.height(); ++c.y) {
    for (c.x = 0; c.x < grid.width(); ++c.x) {
      const Eigen::Vector2d p = grid.center(c);
      if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) grid.at(c) = what;
    }
  }
}

/// Walls of 0.2 m around a floor from (0, 0) to (width, depth), in cells of 5 cm.
inline OccupancyGrid emptyRoom(double width_m, double depth_m) {
  OccupancyGrid grid({-0.2, -0.2}, 0.05, static_cast<int>(std::lround((width_m + 0.4) / 0.05)),
                     static_cast<int>(std::lround((depth_m + 0.4) / 0.05)));
  drawBlock(grid, -1.0, -1.0, width_m + 1.0, 0.0);
  drawBlock(grid, -1.0, depth_m, width_m + 1.0, depth_m + 1.0);
  drawBlock(grid, -1.0, -1.0, 0.0, depth_m + 1.0);
  drawBlock(grid, width_m, -1.0, width_m + 1.0, depth_m + 1.0);
  return grid;
}

/// A room of 8 m x 6 m that looks the same from no two places: an alcove, a pillar and a cupboard.
inline void furnishOddRoom(OccupancyGrid& grid) {
  drawBlock(grid, 5.0, 3.5, 5.4, 6.0);
  drawBlock(grid, 2.0, 1.5, 2.5, 2.0);
  drawBlock(grid, 0.0, 4.4, 1.2, 6.0);
  drawBlock(grid, 6.5, 0.0, 8.0, 0.8);
}
inline OccupancyGrid oddRoom() {
  OccupancyGrid grid = emptyRoom(8.0, 6.0);
  furnishOddRoom(grid);
  return grid;
}

/// A scan without noise, marched in steps of 5 mm: an oracle that shares nothing with castRay().
inline LaserScan scanOf(const OccupancyGrid& grid, const FloorPose& scanner, int beams = 181,
                        double view_rad = kPi) {
  LaserScan scan;
  scan.first_rad = -view_rad / 2.0;
  scan.step_rad = view_rad / (beams - 1);
  for (int i = 0; i < beams; ++i) {
    const double angle = scan.angle(static_cast<std::size_t>(i));
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    double range = 0.0;
    while (range < 20.0 && grid.at(scanner * (range * along)) == Occupancy::kFree) range += 0.005;
    scan.ranges_m.push_back(grid.at(scanner * (range * along)) == Occupancy::kOccupied
                                ? static_cast<float>(range)
                                : std::numeric_limits<float>::infinity());
  }
  return scan;
}

}  // namespace heel::test
