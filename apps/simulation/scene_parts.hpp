// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The larger parts of a scene file, each read on its own.
#pragma once

#include <heel/apps/simulation/scene.hpp>
#include <heel/cloud/yaml_map.hpp>

#include <cmath>
#include <string>

namespace heel {

constexpr double kRadians = M_PI / 180.0;  ///< Of a degree.

/// A colour by name or "#rrggbb"; `fallback` where the key is absent.
Rgb readColor(YamlMap& map, const std::string& key, const Rgb& fallback);

/// A person, whose places must be free in `scene` as read so far (walls and furniture).
ScenePerson readPerson(YamlMap& map, const Scene& scene);

/// A robot and where it starts.
RobotParams readRobot(YamlMap& map);

/// The same without a start: what a robot is, wherever it is.
RobotParams readRobotItself(YamlMap& map);

/// The map that readRobotItself() reads, each key with what it is.
std::string toYaml(const RobotParams& robot, const std::string& indent);

/// With as few digits as give the same number again.
std::string shortestText(double value);

}  // namespace heel
