// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The larger parts of a scene file, each read on its own.
#pragma once

#include <heel/apps/simulation/scene.hpp>
#include <heel/apps/simulation/yaml_map.hpp>

#include <string>

namespace heel {

constexpr double kRadians = 3.14159265358979323846 / 180.0;  ///< Of a degree.

/// A colour by name or "#rrggbb"; `fallback` where the key is absent.
Rgb readColor(YamlMap& map, const std::string& key, const Rgb& fallback);

/// A person, whose places must be free in `scene` as read so far (walls and furniture).
ScenePerson readPerson(YamlMap& map, const Scene& scene);

RobotParams readRobot(YamlMap& map);

}  // namespace heel
