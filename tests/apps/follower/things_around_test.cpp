// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/things_around.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

// Bug: a plain door leaf has no depth, so the robot took the room behind it for looked at.
TEST(ThingsAround, KnowsWhatTheLaserSeesBeforeSomebody) {
  RobotDescription robot;
  const FollowerParams params = fittedTo(robot, {});
  const OccupancyGrid floor({-5.0, -5.0}, 0.05, 200, 200);
  ThingsAround things(robot, params, floor);
  LaserScan scan;  // Of the front half; ahead something is a metre wide.
  scan.first_rad = -1.5;
  scan.step_rad = 0.01;
  for (int i = 0; i <= 300; ++i) {
    const double bearing = scan.angle(static_cast<std::size_t>(i));
    scan.ranges_m.push_back(std::abs(bearing) < 0.25 ? static_cast<float>(2.0 / std::cos(bearing))
                                                     : 6.0F);
  }
  things.begin(0.0, {}, {}, {});
  things.addScan(scan, {});
  things.finish();
  const Vector2d here(0.0, 0.0);
  ASSERT_TRUE(things.firstBetween(here, {3.5, 0.0}));
  EXPECT_NEAR((*things.firstBetween(here, {3.5, 0.0}) - Vector2d(2.0, 0.0)).norm(), 0.0, 0.08);
  EXPECT_FALSE(things.firstBetween(here, {2.2, 0.0})) << "these are their legs";
  EXPECT_FALSE(things.firstBetween(here, {3.0, 2.0}));
}

}  // namespace
}  // namespace heel
