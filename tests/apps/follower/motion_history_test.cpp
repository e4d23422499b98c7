// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/motion_history.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

/// Ten steps a second of 0.1 m, straight ahead.
MotionHistory straight(int steps) {
  MotionHistory motion;
  for (int i = 1; i <= steps; ++i) motion.add(0.1 * i, {{0.1, 0.0}, 0.0});
  return motion;
}

TEST(MotionHistory, TellsWhereTheRobotWas) {
  const MotionHistory motion = straight(20);
  EXPECT_NEAR(motion.at(1.0).position.x(), 1.0, 1e-9);
  EXPECT_NEAR(motion.at(1.25).position.x(), 1.25, 1e-9) << "between two readings";
  EXPECT_NEAR(motion.at(2.05).position.x(), 2.05, 1e-9) << "it went on, as far as is known";
  EXPECT_NEAR(motion.seenFromNow(1.5).position.x(), -0.5, 1e-9);
  EXPECT_EQ(motion.seenFromNow(2.0).position.x(), 0.0);
}

TEST(MotionHistory, KnowsTheOldestPoseThatItHas) {
  EXPECT_NEAR(straight(200).at(0.0).position.x(), 20.0 - 6.3, 0.15);
  EXPECT_EQ(MotionHistory().at(5.0).position.x(), 0.0);
  EXPECT_NEAR(straight(1).at(5.0).position.x(), 0.1, 1e-9) << "one reading has no speed";
}

TEST(MotionHistory, AddsWhatHasNoTimeOfItsOwn) {
  MotionHistory motion = straight(5);
  motion.add(0.5, {{0.2, 0.0}, 0.0});
  EXPECT_NEAR(motion.pose().position.x(), 0.7, 1e-9);
  EXPECT_NEAR(motion.stamp_s(), 0.5, 1e-9);
}

}  // namespace
}  // namespace heel
