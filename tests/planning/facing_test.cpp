// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/trajectory.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace heel {
namespace {

TEST(Facing, TurnsToThePointWithoutGoingPastIt) {
  const DriveLimits limits;
  for (const double yaw : {-3.0, -1.0, 0.3, 2.0}) {
    DriveState state{{{1.0, 1.0}, yaw}, {}};
    const Eigen::Vector2d point(1.0, 4.0);
    double past = 0.0;
    const double side = wrapped(M_PI / 2 - yaw) > 0.0 ? 1.0 : -1.0;
    for (int i = 0; i < 80; ++i) {
      state = driven(limits, state, {0.0, turnToFace(limits, state, point)}, limits.period_s);
      past = std::max(past, -side * wrapped(M_PI / 2 - state.pose.yaw_rad));
    }
    EXPECT_NEAR(state.pose.yaw_rad, M_PI / 2, 0.06) << yaw;
    EXPECT_LT(past, 0.05) << yaw;
    EXPECT_EQ(state.speed.turn_radps, 0.0);
  }
}

TEST(Facing, LeavesASmallAngleAlone) {
  const DriveState state{{{0.0, 0.0}, 0.0}, {}};
  EXPECT_EQ(turnToFace({}, state, {2.0, 0.2}), 0.0);
  EXPECT_GT(turnToFace({}, state, {2.0, 0.5}), 0.0);
}

TEST(Facing, DoesNotTurnToWhatIsNoDirection) {
  const DriveState state{{{1.0, 1.0}, 0.0}, {}};
  EXPECT_EQ(turnToFace({}, state, {1.0, 1.0}), 0.0);
  EXPECT_EQ(turnToFace({}, state, {std::numeric_limits<double>::quiet_NaN(), 0.0}), 0.0);
}

}  // namespace
}  // namespace heel
