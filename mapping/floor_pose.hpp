// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Places on the floor: a pose, the few motions of it, and a disc.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace heel {

/// A place and a heading on the floor; as a transform it maps its own frame to the one it is given
/// in.
struct FloorPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double yaw_rad = 0.0;

  /// `point` of this frame, in the frame that this pose is given in.
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const {
    return position + Eigen::Rotation2Dd(yaw_rad) * point;
  }
  /// First this motion, then `next`, which is given in this pose's frame.
  FloorPose operator*(const FloorPose& next) const;
  FloorPose inverse() const;
};

/// An angle brought to [-pi, pi].
double wrapped(double angle_rad);

/// Base frame to world, for a robot that stands on the floor.
Eigen::Isometry3d basePose(const FloorPose& pose);

/// `pose` after `distance_m` along an arc that turns by `turn_rad`.
FloorPose alongArc(const FloorPose& pose, double distance_m, double turn_rad);

/// Which way a place is from a pose [rad], 0 straight ahead, to the left from there.
double bearingOf(const FloorPose& from, const Eigen::Vector2d& place);

/// What stands on the floor, in the world.
struct FloorDisc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius_m = 0.0;
};

}  // namespace heel
