// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How a camera is mounted over the floor.
#pragma once

#include <Eigen/Geometry>

namespace heel {

/// Height and tilt of a camera. Angles are those of ROS (roll-pitch-yaw of the axes X forward, Y
/// left, Z up), 0 when it looks along the horizon.
struct Mounting {
  double height_m = 0.0;   ///< Of the optical centre over the floor.
  double pitch_rad = 0.0;  ///< > 0: it looks down.
  double roll_rad = 0.0;   ///< > 0: its right side is lower than its left.
};

/// Maps the camera's optical frame (Z forward, X right, Y down) to the base frame: origin on the
/// floor under the camera, Z up, X along the camera's heading.
Eigen::Isometry3d baseFromCamera(const Mounting& mounting);

/// The mounting of a camera whose place in a frame with Z up and z = 0 on the floor is known.
Mounting mountingOf(const Eigen::Isometry3d& T_base_camera);

}  // namespace heel
