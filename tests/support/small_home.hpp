// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A room to follow somebody through, small and fast enough for tests of the whole loop.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <tuple>

namespace heel::test {

/// A room of 7 m x 4 m with two cupboards that tell its sides apart, and a robot at one end with a
/// camera of 160 x 120. Ida, in orange, stands beside the robot for a second, shows herself for
/// three, waits until the robot has seen enough of her, walks two metres on, and waits there.
inline Scene smallHome() {
  Scene scene;
  scene.name = "small home";
  const Eigen::Vector2d corners[] = {{0, 0}, {7, 0}, {7, 4}, {0, 4}};
  const Rgb paints[] = {
      {0.7F, 0.7F, 0.65F}, {0.55F, 0.6F, 0.7F}, {0.7F, 0.7F, 0.7F}, {0.6F, 0.65F, 0.6F}};
  for (int i = 0; i < 4; ++i) {
    Wall wall;
    wall.from = corners[i];
    wall.to = corners[(i + 1) % 4];
    wall.left = wall.right = {"wallpaper", paints[i]};
    scene.walls.push_back(wall);
  }
  for (const auto& [x, y, size] : {std::tuple{3.2, 3.7, 0.9}, std::tuple{6.6, 0.5, 0.6}}) {
    FurniturePart box;
    box.base = {x, y, 0.0};
    box.size_m = {size, 0.5, 1.4};
    box.surface = {"wood", Rgb(0.45F, 0.3F, 0.2F)};
    Furniture cupboard;
    cupboard.name = "cupboard";
    cupboard.parts = {box};
    scene.furniture.push_back(cupboard);
  }
  for (const double x : {1.8, 5.2}) {
    Light lamp;
    lamp.at = {x, 2.0, 2.5};
    lamp.power = 30.0;
    scene.lights.push_back(lamp);
  }

  ScenePerson ida;
  ida.name = "ida";
  ida.height_m = 1.7;
  ida.start = {0.9, 3.0};
  ida.outfit.top.front.color = {0.8F, 0.25F, 0.02F};
  ida.outfit.trousers.front.color = {0.02F, 0.03F, 0.2F};
  const auto wait = [&ida](double wait_s) {
    PathStep step;
    step.wait_s = wait_s;
    ida.path.push_back(step);
  };
  const auto walk = [&ida](double x, double y, double speed_mps) {
    PathStep step;
    step.kind = PathStep::Kind::kWalk;
    step.to = {x, y};
    step.speed_mps = speed_mps;
    ida.path.push_back(step);
  };
  wait(1.3);
  walk(2.9, 2.4, 1.0);
  walk(3.1, 1.7, 0.8);
  walk(2.8, 2.1, 0.8);
  wait(1.2);
  walk(4.8, 2.0, 0.5);
  scene.people.push_back(ida);

  scene.robot.start = {0.8, 2.0};
  scene.robot.camera.width = 160;
  scene.robot.camera.height = 120;
  return scene;
}

}  // namespace heel::test
