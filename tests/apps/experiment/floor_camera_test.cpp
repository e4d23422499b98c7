// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/follower/obstacle_points.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heel {
namespace {

/// What a robot in the middle of a room sees with its floor camera, and nothing else.
std::vector<Eigen::Vector3f> seenIn(Scene scene) {
  scene.robot.floor_camera.emplace();
  Simulator simulator(scene, {1, 0, false});
  const RobotDescription robot = describeRobot(scene.robot);
  ObstaclePoints points(*robot.floor_camera, FollowerParams().floor_points);
  Frame frame;
  frame.depth_m = *simulator.step(0.0).floor_depth_m;
  return points.of(frame);
}

double nearestAhead(const std::vector<Eigen::Vector3f>& points) {
  double nearest_m = 9.0;
  for (const Eigen::Vector3f& p : points) {
    if (std::abs(p.y()) < 0.3F) nearest_m = std::min(nearest_m, static_cast<double>(p.x()));
  }
  return nearest_m;
}

TEST(FloorCamera, SeesNothingOnABareFloor) { EXPECT_TRUE(seenIn(test::squareRoom()).empty()); }

TEST(FloorCamera, SeesAStepThatIsNearerThanALevelCameraSeesFloor) {
  Scene scene = test::squareRoom();
  FloorArea hole;
  hole.low = {0.6, -0.5};
  hole.high = {1.6, 0.5};
  hole.depth_m = 0.15;
  hole.surface = scene.floor;
  scene.floor_areas.push_back(hole);
  const auto points = seenIn(scene);
  EXPECT_NEAR(nearestAhead(points), 0.6, 0.08);
  EXPECT_TRUE(std::all_of(points.begin(), points.end(), [](auto& p) { return p.z() == 0.0F; }));
}

TEST(FloorCamera, SeesABlackChestByTheFloorThatItHides) {
  FurniturePart chest;
  chest.base = {1.0, 0.0, 0.0};
  chest.size_m = {0.4, 0.8, 0.4};
  for (const char* material : {"wood", "velvet"}) {
    Scene scene = test::squareRoom();
    chest.surface.material = material;
    scene.furniture.push_back({"chest", false, {chest}});
    EXPECT_NEAR(nearestAhead(seenIn(scene)), 0.8, 0.05) << material;
  }
}

}  // namespace
}  // namespace heel
