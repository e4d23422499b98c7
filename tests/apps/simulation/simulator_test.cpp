// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(Simulator, GivesTheSameBytesOnAnyNumberOfThreads) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.0, 0.3));
  scene.people[0].path = {{PathStep::Kind::kWalk, {2.0, -1.0}, 1.0, 0.0, 0.0}};
  Simulator one(scene, {7, 1, true}), four(scene, {7, 4, true});
  for (int i = 0; i < 3; ++i) {
    const Readings& a = one.step(i == 0 ? 0.0 : 0.1, {0.3, 0.2});
    const Readings& b = four.step(i == 0 ? 0.0 : 0.1, {0.3, 0.2});
    ASSERT_NE(a.stereo, nullptr);
    EXPECT_TRUE(same(a.stereo->left_bgr, b.stereo->left_bgr));
    EXPECT_TRUE(same(a.stereo->right_bgr, b.stereo->right_bgr));
    EXPECT_TRUE(same(a.stereo->people, b.stereo->people));
    EXPECT_EQ(a.laser->ranges_m, b.laser->ranges_m);
    EXPECT_EQ(a.odometry->position, b.odometry->position);
  }
}

TEST(Simulator, ChangesTheNoiseWithTheSeedAndNothingElse) {
  const Scene scene = test::squareRoom();
  Simulator one(scene, {1, 0, true}), two(scene, {2, 0, true});
  const Readings &a = one.step(0.0), &b = two.step(0.0);
  EXPECT_FALSE(same(a.stereo->left_bgr, b.stereo->left_bgr));
  EXPECT_TRUE(same(a.stereo->depth_m, b.stereo->depth_m));
  cv::Mat difference;
  cv::absdiff(a.stereo->left_bgr, b.stereo->left_bgr, difference);
  EXPECT_LT(cv::mean(difference.reshape(1))[0], 6.0);
}

TEST(Simulator, SeesAWallAtItsDepth) {
  Simulator simulator(test::squareRoom());
  const StereoReading& stereo = *simulator.step(0.0).stereo;
  // The wall's face is half its thickness before its middle line; depth is along the optical axis,
  // so it is the same all over the wall.
  for (const int u : {20, 80, 140}) {
    EXPECT_NEAR(stereo.depth_m.at<float>(60, u), 3.0 - 0.06, 1e-5);
  }
}

TEST(Simulator, SeesTheFloorAtItsDepth) {
  Simulator simulator(test::squareRoom());
  const StereoReading& stereo = *simulator.step(0.0).stereo;
  const PinholeCamera camera = simulator.camera().left;
  for (const int v : {108, 112, 119}) {  // Z = h f / (v - cy) for a level camera.
    EXPECT_NEAR(stereo.depth_m.at<float>(v, 80), camera.fy / (v - camera.cy), 1e-4);
  }
}

TEST(Simulator, MasksAPersonWhereTheirBodyIs) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.5, 1.0));
  scene.people.push_back(test::standingPerson("ida", 2.0, -0.5));
  Simulator simulator(scene);
  const Readings& readings = simulator.step(0.0);
  const PinholeCamera camera = simulator.camera().left;
  const Eigen::Isometry3d T = simulator.T_base_camera();
  int seen[3] = {};
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int who = readings.stereo->people.at<std::uint8_t>(v, u);
      ASSERT_LE(who, 2);
      ++seen[who];
      const double z = readings.stereo->depth_m.at<float>(v, u);
      const Eigen::Vector3d p =
          T * Eigen::Vector3d((u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z);
      for (int i = 1; i <= 2; ++i) {
        const auto& place = readings.truth.people[static_cast<std::size_t>(i - 1)].position;
        const double away = (p.head<2>() - place).norm();
        if (who == i) {
          EXPECT_LT(away, 0.4);
          EXPECT_GT(p.z(), -0.001);
          EXPECT_LT(p.z(), 1.8 * 1.01);
        } else if (away < 0.05 && p.z() > 0.1) {
          ADD_FAILURE() << "a pixel within person " << i << " is not marked";
        }
      }
    }
  }
  EXPECT_GT(seen[1], 500);
  EXPECT_GT(seen[2], 500);
}

TEST(Simulator, ReadsEachSensorAtItsRate) {
  Scene scene = test::squareRoom();
  scene.robot.camera.rate_hz = 5.0;
  scene.robot.laser.rate_hz = 20.0;
  scene.robot.odometry.rate_hz = 50.0;
  Simulator simulator(scene, {1, 0, true});
  int images = 0, scans = 0, odometries = 0;
  for (int i = 0; i <= 100; ++i) {
    const Readings& readings = simulator.step(i == 0 ? 0.0 : 0.01);
    EXPECT_NEAR(readings.stamp_s, 0.01 * i, 1e-9);
    images += readings.stereo != nullptr;
    scans += readings.laser != nullptr;
    odometries += readings.odometry.has_value();
  }
  EXPECT_EQ(images, 6);
  EXPECT_EQ(scans, 21);
  EXPECT_EQ(odometries, 51);
}

TEST(Simulator, StopsTheRobotAtAWallAndSaysSo) {
  Simulator simulator(test::squareRoom(), {1, 0, false});
  bool contact = false;
  for (int i = 0; i < 200; ++i) {
    const Readings& readings = simulator.step(0.1, {0.3, 0.0});
    contact = contact || readings.truth.contact;
    EXPECT_EQ(readings.truth.contact_by_robot, readings.truth.contact) << "walls do not move";
    ASSERT_GT(readings.truth.clearance_m, -0.01);
  }
  EXPECT_TRUE(contact);
}

// Bug: the robot was stopped by a lampshade that hung over it.
TEST(Simulator, LetsTheRobotDriveUnderWhatHangsHigher) {
  for (const double height_m : {1.1, 1.5}) {
    Scene scene = test::squareRoom();
    FurniturePart shade;
    shade.shape = FurniturePart::Shape::kCylinder;
    shade.base = {scene.robot.start.x() + 0.6, scene.robot.start.y(), 1.4};
    shade.radius_m = 0.2;
    shade.height_m = 0.3;
    scene.furniture.push_back({});
    scene.furniture.back().parts = {shade};
    scene.robot.height_m = height_m;
    Simulator simulator(scene, {1, 0, false});
    bool contact = false;
    for (int i = 0; i < 20; ++i) {
      contact = contact || simulator.step(0.1, {0.3, 0.0}).truth.contact;
    }
    EXPECT_EQ(contact, height_m > 1.4) << height_m;
  }
}

TEST(Simulator, ObeysLateWhereTheWheelsAreLate) {
  SimulatorOptions options{1, 0, false};
  options.wheels_latency_s = 0.2;
  Simulator simulator(test::squareRoom(), options);
  const double at_first = simulator.step(0.1, {0.3, 0.0}).truth.robot.position.x();
  EXPECT_EQ(at_first, simulator.step(0.0, {0.3, 0.0}).truth.robot.position.x());
  EXPECT_EQ(simulator.step(0.0).truth.robot_speed.forward_mps, 0.0);
  EXPECT_GT(simulator.step(0.2, {0.3, 0.0}).truth.robot_speed.forward_mps, 0.0);
}

TEST(Simulator, RefusesTimeThatRunsBackwards) {
  Simulator simulator(test::squareRoom(), {1, 0, false});
  EXPECT_THROW(simulator.step(-0.1), std::invalid_argument);
  EXPECT_THROW(simulator.step(0.015), std::invalid_argument);
  EXPECT_THROW(simulator.step(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace heel
