// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The robot that follows, and all that can be set of how it does.
#pragma once

#include <heel/apps/follower/laser_bodies.hpp>
#include <heel/apps/follower/learn_person.hpp>
#include <heel/apps/follower/obstacle_points.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/follower/person_search.hpp>
#include <heel/apps/follower/sensor_watch.hpp>
#include <heel/apps/follower/wall_gate.hpp>
#include <heel/mapping/localization.hpp>
#include <heel/mapping/obstacle_layer.hpp>
#include <heel/planning/global_planner.hpp>
#include <heel/planning/goal_chooser.hpp>
#include <heel/planning/last_gate.hpp>
#include <heel/planning/local_planner.hpp>
#include <heel/planning/wayside.hpp>

#include <optional>

namespace heel {

/// The robot, as far as following needs to know it.
struct RobotDescription {
  DriveLimits drive;              ///< Its size and how it drives.
  double height_m = 1.1;          ///< Its height over the floor: what hangs lower is in its way.
  FloorPose T_base_scanner;       ///< Where the laser scanner is, in the base frame.
  double scanner_height_m = 0.3;  ///< Height of the laser's plane over the floor.
  CameraSetup camera;             ///< Its camera, which looks ahead along the base frame's X axis.
  /// A depth camera (SensorKind::kRgbd, without colours) that looks at the floor ahead, for steps
  /// down and what the others do not see.
  std::optional<CameraSetup> floor_camera;
  /// A scan that comes without a stamp of its own was measured so long before.
  double scan_latency_s = 0.0;
  /// A command acts on the wheels at most so long after it was sent, and odometry that comes
  /// without a stamp of its own was measured so long before.
  double wheels_latency_s = 0.0;

  double halfView_rad() const;  ///< Half the camera's horizontal field of view; 0: unknown.
  /// From so far off a person is in view from knee to head; infinite if never.
  double wholeView_m() const;
};

/// All that can be set of a Follower. Some of it the robot tells, whatever is written here:
/// drive.limits, drive.reacts_s, search.map.limits, paths.robot_radius_m, goal.radius_m,
/// goal.half_view_rad, wayside.radius_m, wayside.person_m, obstacles.min_height_m,
/// obstacles.max_height_m, obstacles.laser_height_m, obstacle_points.max_height_m,
/// floor_points.max_height_m, gate.eye_height_m, whole_m, and of last_gate all but margin_m and
/// sight.remembers_s; see fittedTo().
struct FollowerParams {
  LearnPersonParams learn;
  PerceptionParams perception;
  WallGateParams gate;
  LaserBodiesParams legs;
  LocalizationParams localization;
  ObstacleLayerParams obstacles;
  ObstaclePointsParams obstacle_points;
  ObstaclePointsParams floor_points;  ///< Of the camera that looks at the floor.
  SensorWatchParams watch;
  GlobalPlannerParams paths;
  LocalPlannerParams drive;
  GoalChooserParams goal;
  WaysideParams wayside;
  PersonSearchParams search;
  LastGateParams last_gate;

  FollowerParams();  ///< With what suits following where a part's own default is for other uses.

  /// The robot stops when the person is nearer than this: the paper's metre.
  double near_m = 1.0;
  /// A robot that stands with the person follows again when they are further away than this.
  double far_m = 1.2;
  double whole_m = 2.0;        ///< From so far off all of somebody is in view.
  double beside_m = 0.7;       ///< Somebody this near leaves the robot no room to drive.
  double makes_room_s = 20.0;  ///< The robot leaves the way to somebody for so long at most.
  double waits_aside_s = 6.0;  ///< The robot waits beside the way for so long at most.
  double no_frame_s = 0.25;    ///< Without a picture for longer, tracks go on by the laser.
  double lost_after_s = 0.5;   ///< Without the target's place for longer, it is lost.
  /// Somebody who walked is expected to walk on for so long: where they may be is looked at first,
  /// and avoided.
  double walks_on_s = 2.0;
  double seek_radps = 0.9;       ///< Speed of turning while the robot looks around for the target.
  double ahead_rad = 0.3;        ///< What is within this angle of straight ahead is in view.
  double lost_turn_radps = 0.4;  ///< Speed of turning of a robot that does not know where it is.
  /// A robot that was blocked for so long is as near to its goal as it can get.
  double give_up_s = 4.0;
  /// Whatever rests and may be a person with this probability is avoided as one: to touch somebody
  /// costs as much as twenty ways around nobody. Whatever walks is, if it is likelier a person than
  /// none.
  double avoid_above = 0.05;
  /// Paths lead around people with so much more room than around things.
  double beside_people_m = 0.05;
  double target_radius_m = 0.45;   ///< Readings this near to the target are the target's own.
  double mapped_within_m = 0.15;   ///< What is seen this near to something on the map is that.
  double obstacles_every_s = 0.2;  ///< How often the camera looks for obstacles.
};

/// The parameters with what the parts must know of the robot: its size, its limits, its camera.
/// @throws std::invalid_argument  if a parameter of the follower itself is out of its range.
FollowerParams fittedTo(const RobotDescription& robot, FollowerParams params);

}  // namespace heel
