// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/follower_params.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

/// A robot whose camera sees so far to each side.
RobotDescription robotWithHalfView(double half_view_rad) {
  RobotDescription robot;
  robot.camera.camera.left.width = 320;
  robot.camera.camera.left.fx = 160.0 / std::tan(half_view_rad);
  return robot;
}

TEST(FollowerParams, AreFittedToTheRobot) {
  RobotDescription robot = robotWithHalfView(0.6);
  robot.drive.radius_m = 0.31;
  robot.drive.max_speed_mps = 0.7;
  robot.height_m = 1.4;
  robot.scanner_height_m = 0.2;
  robot.camera.T_base_camera.translation().z() = 1.25;
  const FollowerParams params = fittedTo(robot, {});
  EXPECT_EQ(params.paths.robot_radius_m, 0.31);
  EXPECT_EQ(params.goal.radius_m, 0.31);
  EXPECT_EQ(params.wayside.radius_m, 0.31);
  EXPECT_EQ(params.drive.limits.max_speed_mps, 0.7);
  EXPECT_EQ(params.obstacles.max_height_m, 1.4);
  EXPECT_EQ(params.obstacle_points.max_height_m, 1.4) << "what hangs as low as its top";
  EXPECT_EQ(params.obstacles.laser_height_m, 0.2);
  EXPECT_EQ(params.gate.eye_height_m, 1.25);
}

TEST(FollowerParams, ANarrowCameraSeesNoMoreThanItDoes) {
  const FollowerParams defaults;
  const FollowerParams wide = fittedTo(robotWithHalfView(1.2), {});
  EXPECT_EQ(wide.search.map.field_of_view_rad, defaults.search.map.field_of_view_rad);
  EXPECT_EQ(wide.drive.terms.half_view_rad, defaults.drive.terms.half_view_rad);
  const FollowerParams narrow = fittedTo(robotWithHalfView(0.3), {});
  EXPECT_NEAR(narrow.search.map.field_of_view_rad, 0.6, 1e-12);
  EXPECT_LT(narrow.drive.terms.half_view_rad, 0.3);
  EXPECT_EQ(narrow.goal.half_view_rad, narrow.drive.terms.half_view_rad);
}

TEST(FollowerParams, AllOfSomebodyIsInViewFromWhereTheCameraSeesKneeAndHead) {
  RobotDescription robot;
  robot.camera.camera.left = {320,   240,   240.0,
                              240.0, 160.0, 120.0};  // half its distance up and down
  robot.camera.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  robot.camera.T_base_camera.translation().z() = 1.25;
  EXPECT_NEAR(robot.wholeView_m(), (1.25 - 0.4) / 0.5, 1e-9);
  robot.camera.T_base_camera.translation().z() = 0.75;
  EXPECT_NEAR(robot.wholeView_m(), (1.75 - 0.75) / 0.5, 1e-9);
  EXPECT_EQ(fittedTo(robot, {}).whole_m, robot.wholeView_m());
  robot.camera.T_base_camera.rotate(Eigen::AngleAxisd(-0.6, Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(std::isinf(robot.wholeView_m())) << "it sees no head, however far off";
  EXPECT_EQ(fittedTo(robot, {}).whole_m, FollowerParams().search.map.max_range_m);
}

TEST(FollowerParams, ThatMakeNoSenseAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(FollowerParams&)>> mistakes = {
      [](auto& p) { p.near_m = p.far_m + 0.1; },
      [](auto& p) { p.give_up_s = -1.0; },
      [&](auto& p) { p.seek_radps = nan; },
      [](auto& p) { p.wayside.reach_m = -1.0; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    FollowerParams params;
    EXPECT_NO_THROW(fittedTo({}, params));
    mistakes[i](params);
    EXPECT_THROW(fittedTo({}, params), std::invalid_argument) << i;
  }
}

TEST(FollowerParams, EachPartRefusesItsOwnThatMakeNoSense) {
  ObstaclePointsParams points;
  points.nearest_m = 0.0;
  EXPECT_THROW(ObstaclePoints({}, points), std::invalid_argument);
  points = {};
  points.max_height_m = points.min_height_m;
  EXPECT_THROW(ObstaclePoints({}, points), std::invalid_argument);
  LaserBodiesParams legs;
  legs.max_width_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LaserBodies{legs}, std::invalid_argument);
}

}  // namespace
}  // namespace heel
