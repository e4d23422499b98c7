// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/drive_base.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

TEST(DriveBase, ObeysItsLimitsOfSpeedAndAcceleration) {
  const RobotParams params;
  DriveBase robot(params);
  double last = 0.0;
  for (int i = 0; i < 200; ++i) {
    robot.accelerate(0.01, {5.0, 9.0});
    EXPECT_LE(robot.speed().forward_mps - last, params.drive.max_acceleration_mps2 * 0.01 + 1e-12);
    last = robot.speed().forward_mps;
    robot.go(0.01);
  }
  EXPECT_DOUBLE_EQ(robot.speed().forward_mps, 0.3);
  EXPECT_DOUBLE_EQ(robot.speed().turn_radps, params.drive.max_turn_radps);
}

TEST(WheelOdometry, DriftsWithTheStatisticsThatAreConfigured) {
  OdometryParams params;
  params.distance_noise = 0.03;
  params.turn_noise = 0.02;
  params.drift_noise = 0.015;
  const double distance_m = 4.0, turn_rad = 3.0;
  const int runs = 4000, steps = 50;
  double way = 0.0, way2 = 0.0, heading = 0.0, heading2 = 0.0;
  for (int run = 0; run < runs; ++run) {
    // First straight on, then on the spot: so both errors can be read off.
    WheelOdometry odometry(params, hashOf(11, static_cast<std::uint64_t>(run)));
    OdometryParams straight_params = params;
    straight_params.drift_noise = 0.0;
    WheelOdometry straight(straight_params, hashOf(12, static_cast<std::uint64_t>(run)));
    for (int i = 0; i < steps; ++i) {
      odometry.add(distance_m / steps, 0.0);
      straight.add(distance_m / steps, 0.0);
    }
    for (int i = 0; i < steps; ++i) odometry.add(0.0, turn_rad / steps);
    const double along = straight.pose().position.x() - distance_m;
    const double turned = std::remainder(odometry.pose().yaw_rad - turn_rad, 2 * 3.14159265358979);
    way += along / runs;
    way2 += along * along / runs;
    heading += turned / runs;
    heading2 += turned * turned / runs;
  }
  const double way_sigma = 0.03 * std::sqrt(distance_m);
  const double heading_sigma =
      std::hypot(0.02 * std::sqrt(turn_rad), 0.015 * std::sqrt(distance_m));
  // Of 4000 runs a mean is known to sigma / 63, a deviation to 1.1 %: four times that is allowed.
  EXPECT_NEAR(way, 0.0, 4 * way_sigma / std::sqrt(runs));
  EXPECT_NEAR(std::sqrt(way2), way_sigma, 0.045 * way_sigma);
  EXPECT_NEAR(heading, 0.0, 4 * heading_sigma / std::sqrt(runs));
  EXPECT_NEAR(std::sqrt(heading2), heading_sigma, 0.045 * heading_sigma);
}

TEST(WheelOdometry, IsExactWithoutNoise) {
  WheelOdometry odometry({10.0, 0.0, 0.0, 0.0}, 1);
  odometry.add(1.0, 0.0);
  odometry.add(0.0, 1.5707963267948966);
  odometry.add(2.0, 0.0);
  EXPECT_NEAR(odometry.pose().position.x(), 1.0, 1e-12);
  EXPECT_NEAR(odometry.pose().position.y(), 2.0, 1e-12);
}

}  // namespace
}  // namespace heel
