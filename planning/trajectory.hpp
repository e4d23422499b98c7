// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a differential drive can do, where a command leads, and how it turns to face a point.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/surroundings.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace heel {

/// A speed along the robot's heading and a turn.
struct VelocityCommand {
  double forward_mps = 0.0;
  double turn_radps = 0.0;  ///< To the left is positive.
};

/// The robot as a disc that drives and turns, or as what such a disc covers whose middle is drawn
/// along the base's X axis: the body's axis. The defaults are a Pioneer 3-DX at the paper's speed.
struct DriveLimits {
  double radius_m = 0.26;      ///< Of the disc.
  double front_m = 0.0;        ///< The axis ends here, ahead of the base's origin,
  double back_m = 0.0;         ///< and begins here; both are 0 for a round robot.
  double max_speed_mps = 0.3;  ///< Greatest speed forwards.
  /// Greatest speed backwards: to make room for somebody, to a place close behind it, and of a long
  /// body to where it can turn.
  double max_reverse_mps = 0.15;
  double max_turn_radps = 1.0;                ///< Greatest speed of turning.
  double max_acceleration_mps2 = 0.5;         ///< Greatest acceleration.
  double max_braking_mps2 = 1.0;              ///< Greatest deceleration.
  double max_turn_acceleration_radps2 = 2.0;  ///< Greatest acceleration of turning, and of its end.
  double period_s = 0.1;                      ///< Time from one command to the next.
};

/// @throws std::invalid_argument  unless every limit is positive and finite, and so is the axis.
void checkLimits(const DriveLimits& limits);

/// The body of these limits of the least area that holds these corners [m, base].
DriveLimits withBodyAround(const std::vector<Eigen::Vector2d>& corners, DriveLimits limits);

/// A straight line from one place on the floor to another [m].
struct FloorLine {
  Eigen::Vector2d from, to;

  Eigen::Vector2d nearest(const Eigen::Vector2d& place) const;  ///< Its point nearest to a place.
};

/// Between the points of two lines that are nearest to each other [m].
double distanceBetween(const FloorLine& a, const FloorLine& b);

/// The body's axis, from its back to its front.
FloorLine axisOf(const DriveLimits& limits, const FloorPose& T_world_base);

/// How far the axis reaches from the base's origin [m].
double axisReach(const DriveLimits& limits);

/// The radius of the disc that the body needs to turn on the spot [m].
double turningRadius(const DriveLimits& limits);

/// The room around the body; negative in a collision, NaN where nobody knows. It is looked at in
/// discs along the axis, and may be too small by 3.2 % of the radius, never too large [m].
double roomAround(const DriveLimits& limits, const FloorPose& T_world_base, Clearance clearance);

/// Where a robot is and how it moves.
struct DriveState {
  FloorPose pose;
  VelocityCommand speed;
};

/// A speed that changes evenly: to there, at this rate.
struct EvenChange {
  double to;
  double rate;
};

/// How a forward speed begins to change to another: one that is to go the other way brakes to a
/// stand first.
EvenChange changeOf(const DriveLimits& limits, double from_mps, double to_mps);

/// The velocity `dt_s` later, if it goes from one to the other as fast as the limits allow.
VelocityCommand speedAfter(const DriveLimits& limits, const VelocityCommand& from,
                           const VelocityCommand& to, double dt_s);

/// `state` after `dt_s` in which the speed goes to `wanted` as fast as the limits allow.
DriveState driven(const DriveLimits& limits, const DriveState& state, const VelocityCommand& wanted,
                  double dt_s);

/// The way to a stand from `speed_mps` when the brakes are hit `latency_s` from now [m].
double stoppingDistance(const DriveLimits& limits, double speed_mps, double latency_s);

/// The greatest speed from which the robot stands after `way_m` [m/s].
double speedToStopWithin(const DriveLimits& limits, double way_m);

/// Futures of the robot, one row of `steps` poses each, a control period apart; row by row.
struct Trajectories {
  std::size_t steps = 0;
  std::vector<VelocityCommand> commands;  ///< What to do now to begin each.
  std::vector<FloorPose> poses;           ///< `poses[row * steps + step]`, from one period on.

  std::size_t size() const { return commands.size(); }
  const FloorPose* row(std::size_t i) const { return poses.data() + i * steps; }
  void clear() {
    commands.clear();
    poses.clear();
  }
};

/// Adds the future in which one command is held.
void addHeld(const DriveLimits& limits, const DriveState& now, const VelocityCommand& command,
             Trajectories& out);

/// How the robot turns on the spot.
struct FacingParams {
  double gain = 1.8;  ///< Speed of turning per angle that is left [1/s].
};

/// The turn in rad/s that brings the robot round to `point`: proportional, never so fast that it
/// could not stop in time, and none when it faces the point. 0 for a point that isn't finite or is
/// under the robot.
double turnToFace(const DriveLimits& limits, const DriveState& now, const Eigen::Vector2d& point,
                  const FacingParams& params = {});

}  // namespace heel
