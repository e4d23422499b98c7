// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// robot.yaml: a robot, and what its user sets of how it follows.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/simulation/scene.hpp>

#include <string>

namespace heel {

/// The contents of a robot.yaml. What is absent there has its default.
struct RobotConfig {
  RobotParams robot;               ///< `robot`, with the keys of a scene's robot but for its start.
  bool tells_laser = false;        ///< Whether `robot` has a `laser`; else its place is a guess.
  CameraSetupParams camera_setup;  ///< `camera_setup`: of a log's camera.
  FollowerParams follow;           ///< `follow`: some of them, named as they are in the struct.
};

/// @throws std::runtime_error  one sentence with file, line and key: a key that is unknown (it
/// names
///                             the nearest) or there twice, a value that is no number, not finite
///                             or out of its range; parameters that do not go together.
RobotConfig loadRobotConfig(const std::string& file);

/// The file of a configuration, each key with its unit and what it is for.
std::string toYaml(const RobotConfig& config);

/// The scene with this robot, which starts where the scene's does. Whether the light is drawn stays
/// as the scene says, if the robot does not ask for it.
void putRobot(Scene& scene, const RobotParams& robot);

}  // namespace heel
