// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Small scenes for the tests of the simulation.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <string>

namespace heel::test {

inline std::string sceneFile(const std::string& name) {
  return std::string(HEEL_SOURCE_DIR) + "/apps/scenes/" + name + ".yaml";
}

/// A square room of 6 m with a lamp and a small camera 1 m above the floor, in its middle, that
/// looks along +x.
inline Scene squareRoom() {
  Scene scene;
  const Eigen::Vector2d corners[] = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  for (int i = 0; i < 4; ++i) {
    Wall wall;
    wall.from = corners[i];
    wall.to = corners[(i + 1) % 4];
    wall.skirting_m = 0.0;
    wall.left = wall.right = {"wallpaper", Rgb(0.7F, 0.7F, 0.7F)};
    scene.walls.push_back(wall);
  }
  Light lamp;
  lamp.at = {0.0, 0.0, 2.5};
  scene.lights.push_back(lamp);
  scene.robot.camera.at = {0.0, 0.0, 1.0};
  scene.robot.camera.width = 160;
  scene.robot.camera.height = 120;
  return scene;
}

/// Someone of 1.8 m in red who stands at a place.
inline ScenePerson standingPerson(const std::string& name, double x, double y) {
  ScenePerson person;
  person.name = name;
  person.height_m = 1.8;
  person.start = {x, y};
  person.outfit.top.front.color = {0.5F, 0.02F, 0.02F};
  return person;
}

}  // namespace heel::test
