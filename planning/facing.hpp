// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Turning on the spot to face a point.
#pragma once

#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>

namespace heel {

struct FacingParams {
  double gain = 1.8;        ///< Speed of turning per angle that is left [1/s].
  double still_rad = 0.05;  ///< A turn ends when no more than this is left of it.
  double begin_rad = 0.12;  ///< A robot that stands turns only for more than this.
};

/// The turn in rad/s that brings the robot round to `point`: proportional, never so fast that it
/// could not stop in time, and none when it faces the point. 0 for a point that isn't finite or is
/// under the robot.
double turnToFace(const DriveLimits& limits, const DriveState& now, const Eigen::Vector2d& point,
                  const FacingParams& params = {});

}  // namespace heel
