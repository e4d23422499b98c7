// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A differential-drive robot and what its wheels tell.
#pragma once

#include <heel/apps/simulation/random.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/trajectory.hpp>

namespace heel {

/// A robot that obeys its limits of speed and acceleration.
class DriveBase {
 public:
  explicit DriveBase(const RobotParams& params);

  /// Changes the speed towards the command for `dt_s`.
  void accelerate(double dt_s, const VelocityCommand& command);

  /// Something is in the way: it stands, or only turns.
  void stop(bool may_turn);

  /// Moves for `dt_s` at the present speed.
  void go(double dt_s);

  /// Where `go` would lead.
  FloorPose ahead(double dt_s) const;

  const FloorPose& pose() const { return pose_; }
  const VelocityCommand& speed() const { return speed_; }

 private:
  RobotParams params_;
  FloorPose pose_;
  VelocityCommand speed_;
};

/// Dead reckoning with errors that grow with the way gone. Starts at 0, heading 0.
///
/// After a way of d metres and turns of a radians in all, the error of the heading is normally
/// distributed with variance turn_noise^2 a + drift_noise^2 d, that of the way gone with variance
/// distance_noise^2 d. The biases come on top of that.
class WheelOdometry {
 public:
  WheelOdometry(const OdometryParams& params, std::uint64_t seed);

  void add(double distance_m, double turn_rad);
  const FloorPose& pose() const { return pose_; }

 private:
  OdometryParams params_;
  RandomStream random_;
  FloorPose pose_;
};

}  // namespace heel
