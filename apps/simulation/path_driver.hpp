// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Drives a simulated robot along a path that is given.
#pragma once

#include <heel/apps/simulation/simulator.hpp>
#include <heel/planning/path.hpp>

#include <cstddef>

namespace heel {

/// How fast a robot that is driven goes about.
inline constexpr double kDrivenSpeed_mps = 0.3;

/// Turns towards a place, and goes there once it lies ahead.
VelocityCommand steerTo(const FloorPose& robot, const Eigen::Vector2d& place);

/// Whether somebody stands before the robot.
bool isSomebodyAhead(const WorldTruth& truth);

/// Goes from one point to the next, waits for people in its way, and stands at the end. It knows
/// the truth.
class PathDriver {
 public:
  explicit PathDriver(FloorPath path);

  VelocityCommand drive(const WorldTruth& truth);

 private:
  FloorPath path_;
  std::size_t next_ = 0;
};

}  // namespace heel
