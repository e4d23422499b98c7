// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Small scans and points for tests of the obstacle layer.
#pragma once

#include <heel/mapping/obstacle_layer.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace heel::test {

/// A beam straight ahead, and no other.
inline LaserScan oneBeam(double range_m, double angle_rad = 0.0) {
  LaserScan scan;
  scan.first_rad = angle_rad;
  scan.ranges_m = {static_cast<float>(range_m)};
  return scan;
}

/// All around in `beams` steps, each of this range.
inline LaserScan around(int beams, double range_m) {
  LaserScan scan;
  scan.step_rad = 2.0 * 3.141592653589793 / beams;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), static_cast<float>(range_m));
  return scan;
}

/// The same point so often that it counts.
inline std::vector<Eigen::Vector3f> thrice(double x, double y, double z) {
  return std::vector<Eigen::Vector3f>(3, Eigen::Vector3d(x, y, z).cast<float>());
}

inline void seeScan(ObstacleLayer& layer, double stamp_s, const LaserScan& scan,
                    const FloorPose& pose = {}) {
  layer.begin(stamp_s, pose);
  layer.addScan(scan, {});
  layer.finish();
}

inline void seePoints(ObstacleLayer& layer, double stamp_s,
                      const std::vector<Eigen::Vector3f>& points, const FloorPose& pose = {}) {
  layer.begin(stamp_s, pose);
  layer.addPoints(points);
  layer.finish();
}

inline void seeNothing(ObstacleLayer& layer, double stamp_s, const FloorPose& pose = {}) {
  layer.begin(stamp_s, pose);
  layer.finish();
}

inline bool occupied(const ObstacleLayer& layer, double x, double y) {
  return layer.window().at(Eigen::Vector2d(x, y)) == Occupancy::kOccupied;
}

}  // namespace heel::test
