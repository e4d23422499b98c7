// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/floor_pose.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

TEST(FloorPose, ManySmallArcsCloseACircle) {
  FloorPose pose;
  for (int i = 0; i < 1000; ++i) pose = alongArc(pose, 2.0 * M_PI * 0.5 / 1000, 2.0 * M_PI / 1000);
  EXPECT_NEAR(pose.position.norm(), 0.0, 1e-9);
  EXPECT_NEAR(wrapped(pose.yaw_rad), 0.0, 1e-9);
}

TEST(FloorPose, AQuarterCircleEndsARadiusAheadAndARadiusToTheLeft) {
  const FloorPose quarter = alongArc({}, 0.5 * M_PI / 2.0, M_PI / 2.0);
  EXPECT_NEAR(quarter.position.x(), 0.5, 1e-12);
  EXPECT_NEAR(quarter.position.y(), 0.5, 1e-12);
  EXPECT_NEAR(quarter.yaw_rad, M_PI / 2.0, 1e-12);
}

TEST(FloorPose, AMotionAndItsInverseAreNone) {
  const FloorPose motion{{0.3, -1.2}, 2.5};
  const FloorPose none = motion * motion.inverse();
  EXPECT_NEAR(none.position.norm(), 0.0, 1e-12);
  EXPECT_NEAR(wrapped(none.yaw_rad), 0.0, 1e-12);
  EXPECT_NEAR(
      (motion.inverse() * (motion * Eigen::Vector2d(1.0, 2.0)) - Eigen::Vector2d(1.0, 2.0)).norm(),
      0.0, 1e-12);
}

TEST(FloorPose, BearingsAreLeftOfAhead) {
  const FloorPose pose{{1.0, 1.0}, M_PI / 2.0};
  EXPECT_NEAR(bearingOf(pose, {1.0, 3.0}), 0.0, 1e-12);
  EXPECT_NEAR(bearingOf(pose, {0.0, 1.0}), M_PI / 2.0, 1e-12);
  EXPECT_NEAR(bearingOf(pose, {2.0, 1.0}), -M_PI / 2.0, 1e-12);
}

}  // namespace
}  // namespace heel
