// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

/// A laser at the camera's place, so that both see the same.
Scene sceneWithLaserAtCamera() {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.0, 0.4));
  Furniture pillar;
  pillar.parts.emplace_back();
  pillar.parts[0].shape = FurniturePart::Shape::kCylinder;
  pillar.parts[0].base = {1.8, -0.6, 0.0};
  pillar.parts[0].radius_m = 0.2;
  pillar.parts[0].height_m = 1.5;
  scene.furniture.push_back(pillar);
  scene.robot.laser.at = scene.robot.camera.at;
  scene.robot.camera.height = 121;  // So that a row of pixels is level with the camera.
  return scene;
}

TEST(Laser, AgreesWithTheDepthImage) {
  Scene scene = sceneWithLaserAtCamera();
  scene.robot.laser.noise_m = 0.0;
  scene.robot.laser.view_rad = 0.9;
  scene.robot.laser.beams = 400;
  Simulator simulator(scene);
  const Readings& readings = simulator.step(0.0);
  const PinholeCamera camera = simulator.camera().left;
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = readings.laser->first_rad + i * readings.laser->step_rad;
    const double u = camera.cx - camera.fx * std::tan(angle);
    const int near = static_cast<int>(std::lround(u));
    const double depth = readings.laser->ranges_m[static_cast<std::size_t>(i)] * std::cos(angle);
    const float* row = readings.stereo->depth_m.ptr<float>(60);
    const double low = std::min({row[near - 1], row[near], row[near + 1]});
    const double high = std::max({row[near - 1], row[near], row[near + 1]});
    EXPECT_GE(depth, low - 0.01);
    EXPECT_LE(depth, high + 0.01);
    compared += high - low < 0.05;
  }
  EXPECT_GT(compared, 300);
}

TEST(Laser, HasTheNoiseThatIsConfigured) {
  Scene scene = test::squareRoom();
  scene.robot.laser.at = {0.0, 0.0, 1.0};
  scene.robot.laser.noise_m = 0.02;
  scene.robot.laser.view_rad = 0.02;
  scene.robot.laser.beams = 21;
  Simulator simulator(scene, {3, 0, false});
  double sum = 0.0, sum2 = 0.0;
  int count = 0;
  for (int i = 0; i < 200; ++i) {
    for (const float range : simulator.step(0.1).laser->ranges_m) {
      const double error = range - 2.94;  // The wall's face; obliqueness adds under 0.2 mm.
      sum += error;
      sum2 += error * error;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.02, 0.001);
}

// Beams of 1 degree end on two legs with a gap between them, or on all of a skirt.
TEST(Laser, SeesNoLegsInALongSkirt) {
  for (const bool skirt : {false, true}) {
    Scene scene = test::squareRoom();
    scene.people.push_back(test::standingPerson("eva", 1.0, 0.0));
    scene.people[0].outfit.skirt = skirt;
    scene.people[0].start_yaw_rad = M_PI;
    Simulator simulator(scene, {1, 0, false});
    const LaserScan& scan = *simulator.step(0.0).laser;
    int hits = 0, edges = 0;
    for (std::size_t i = 1; i < scan.ranges_m.size(); ++i) {
      const bool before = scan.ranges_m[i - 1] < 1.5F, now = scan.ranges_m[i] < 1.5F;
      hits += now ? 1 : 0;
      edges += before != now ? 1 : 0;
    }
    EXPECT_EQ(edges, skirt ? 2 : 4);
    EXPECT_GT(hits, skirt ? 18 : 5);
  }
}

TEST(Laser, GoesThroughGlassAndHasNoEchoOfVelvet) {
  FurniturePart pane;
  pane.base = {1.5, 0.0, 0.0};
  pane.size_m = {0.05, 6.0, 2.0};
  const auto ahead_m = [&](const char* material) {
    Scene scene = test::squareRoom();
    scene.robot.laser.at = {0.0, 0.0, 1.0};
    scene.robot.laser.noise_m = 0.0;
    pane.surface.material = material;
    scene.furniture.push_back({"pane", true, {pane}});
    Simulator simulator(scene, {1, 0, false});
    return simulator.step(0.0).laser->ranges_m[90];
  };
  EXPECT_NEAR(ahead_m("wood"), 1.475F, 1e-3F);
  EXPECT_NEAR(ahead_m("frosted glass"), 2.94F, 1e-3F) << "the wall behind it";
  EXPECT_TRUE(std::isinf(ahead_m("velvet")));
}

TEST(FloorCamera, MeasuresTheFloorAndWhatStandsOnIt) {
  Scene scene = test::squareRoom();
  FurniturePart chest;
  chest.base = {1.0, 0.0, 0.0};
  chest.size_m = {0.4, 0.8, 0.5};
  scene.furniture.push_back({"chest", true, {chest}});
  scene.robot.floor_camera.emplace().noise_m = 0.0;
  const FloorCameraParams& params = *scene.robot.floor_camera;
  Simulator simulator(scene, {1, 0, false});
  const cv::Mat& depth_m = *simulator.step(0.0).floor_depth_m;
  ASSERT_EQ(depth_m.size(), cv::Size(params.width, params.height));
  const Eigen::Isometry3d T = mountedCamera(params.at, params.pitch_rad);
  int on_floor = 0, on_chest = 0;
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double depth = depth_m.at<float>(v, u);
      const Eigen::Vector3d seen = T * (depth * rayOf(pinholeOf(params), u, v));
      on_floor += std::abs(seen.z()) < 1e-3 ? 1 : 0;
      on_chest += std::abs(seen.z() - 0.5) < 1e-3 && std::abs(seen.x() - 1.0) < 0.2 + 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(on_floor, 5000);
  EXPECT_GT(on_chest, 1000);
}

TEST(Laser, SeesNothingBeyondItsRange) {
  Scene scene = test::squareRoom();
  scene.robot.laser.max_range_m = 2.0;
  Simulator simulator(scene, {1, 0, false});
  for (const float range : simulator.step(0.0).laser->ranges_m) EXPECT_TRUE(std::isinf(range));
}

TEST(Laser, MeetsLegs) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.0, 0.0));
  Simulator simulator(scene, {1, 0, false});
  int hits = 0;
  for (const float range : simulator.step(0.0).laser->ranges_m) hits += range < 2.2F;
  EXPECT_GT(hits, 3);
  EXPECT_LT(hits, 20);
}

}  // namespace
}  // namespace heel
