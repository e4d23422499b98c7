// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The robot that follows, and all that can be set of how it does.
#pragma once

#include "apps/follower/laser_bodies.hpp"
#include "apps/follower/learn_person.hpp"
#include "apps/follower/obstacle_points.hpp"
#include "apps/follower/perception.hpp"
#include "apps/follower/person_search.hpp"
#include "apps/follower/sensor_watch.hpp"
#include "apps/follower/wall_gate.hpp"
#include "mapping/localization.hpp"
#include "mapping/obstacle_layer.hpp"
#include "planning/global_planner.hpp"
#include "planning/goal_chooser.hpp"
#include "planning/local_planner.hpp"
#include "planning/wayside.hpp"

namespace heel {

/// The robot, as far as following needs to know it.
struct RobotDescription {
  DriveLimits drive;
  double height_m = 1.1;
  FloorPose T_base_scanner;
  double scanner_height_m = 0.3;
  CameraSetup camera;  ///< Looks ahead, along the base frame's X axis.

  double halfView_rad() const;  ///< Half the camera's horizontal field of view; 0: unknown.
};

/// All that can be set of a Follower. Some of it the robot tells, whatever is written here:
/// drive.limits, paths.robot_radius_m, goal.radius_m, wayside.radius_m, obstacles.max_height_m,
/// obstacles.laser_height_m, obstacle_points.max_height_m and gate.eye_height_m; see fittedTo().
struct FollowerParams {
  LearnPersonParams learn;
  PerceptionParams perception;
  WallGateParams gate;
  LaserBodiesParams legs;
  LocalizationParams localization;
  ObstacleLayerParams obstacles;
  ObstaclePointsParams obstacle_points;
  SensorWatchParams watch;
  GlobalPlannerParams paths;
  LocalPlannerParams drive;
  GoalChooserParams goal;
  WaysideParams wayside;
  PersonSearchParams search;

  FollowerParams();  ///< With what suits following where a part's own default is for other uses.

  double near_m = 1.0;           ///< The paper's metre: nearer than this the robot stops ...
  double far_m = 1.2;            ///< ... until the person is further than this.
  double beside_m = 0.7;         ///< Somebody this near leaves the robot no room to drive.
  double comes_mps = 0.15;       ///< Who comes nearer than far_m at this speed wants to get past.
  double makes_room_s = 20.0;    ///< Leaves the way to them for so long at most, ...
  double waits_aside_s = 6.0;    ///< ... and for so long once it is out of their way.
  double no_frame_s = 0.25;      ///< Without a picture for longer, tracks go on by the laser.
  double lost_after_s = 0.5;     ///< Without the target's place for longer, it is lost.
  double worth_a_look = 0.05;    ///< Who is the target with more than this probability may be them.
  double walks_on_s = 2.0;       ///< Who walked is expected to walk on for so long.
  double first_looks_s = 5.0;    ///< Who may be a lost person is looked at for so long at once,
  double look_share = 0.15;      ///< and in this share of the time in all.
  double seek_radps = 0.9;       ///< Turn of a seek.
  double ahead_rad = 0.3;        ///< What is within this of straight ahead is in view.
  double lost_turn_radps = 0.4;  ///< Turn of a robot that does not know where it is.
  double give_up_s = 4.0;        ///< Blocked for so long, it is as near as it can get.
  double surely_person = 0.8;    ///< Who is there with this probability is avoided as a person.
  double stands_mps = 0.15;      ///< Who is slower stands: paths go around them, ...
  double beside_people_m = 0.05;   ///< ... with so much more room than around things.
  double target_radius_m = 0.45;   ///< Readings this near to the target are the target's own.
  double mapped_within_m = 0.15;   ///< What is seen this near to what the map shows is that.
  double obstacles_every_s = 0.2;  ///< How often the camera looks for obstacles.
};

/// The parameters with what the parts must know of the robot: its size, its limits, its camera.
/// @throws std::invalid_argument  if a parameter of the follower itself is out of its range.
FollowerParams fittedTo(const RobotDescription& robot, FollowerParams params);

}  // namespace heel
