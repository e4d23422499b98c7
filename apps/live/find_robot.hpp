// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A robot on the network: its camera, its laser, its wheels.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/live/live_network.hpp>
#include <heel/apps/live/live_readings.hpp>

#include <functional>
#include <memory>
#include <string>

namespace heel {

struct FoundRobot {
  std::unique_ptr<LiveReadings> readings;
  CameraSetup camera;
};

/// Listens until the messages of a robot's camera, laser, wheels and tf have come, and leaves only
/// their topics subscribed.
/// @param knows_scanner  Whether the laser's place on the robot is known if tf does not tell it.
/// @param goes_on  Asked about once a second, and told what is missing still; false ends the
/// search.
/// @throws std::runtime_error  if it was ended, with what is missing; as findCameraSetup().
FoundRobot findRobot(LiveNetwork& network, const BagTopics& topics,
                     const CameraSetupParams& camera_setup, bool knows_scanner,
                     const std::function<bool(const std::string& missing)>& goes_on);

}  // namespace heel
