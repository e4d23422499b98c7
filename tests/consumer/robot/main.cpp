// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/follower.hpp>
#include <heel/mapping/wall_map_builder.hpp>
#include <heel/planning/plan_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

//! [behaviour]
struct Wait : heel::Behaviour {
  std::optional<heel::Intent> step(const heel::Situation& now, const heel::Ways&) override {
    heel::Intent intent;
    intent.look_at = now.last.position;  // where the person was seen last
    return intent;
  }
};
//! [behaviour]

/// The follower on a robot of one's own: in a square room of 4 m, nobody there, no camera frame
/// yet. It must stand, in phase 1, and know where it is.
int main() {
  heel::WallMapBuilder room;
  for (const double side : {-2.0, 2.0}) {
    room.add(heel::WallBox{{side, 0.0}, 0.0, {0.1, 4.2}, {0.0, 2.0}});
    room.add(heel::WallBox{{0.0, side}, 0.0, {4.2, 0.1}, {0.0, 2.0}});
  }
  room.addFreeFloor({-2.0, -2.0}, {2.0, 2.0});

  //! [robot]
  heel::RobotDescription robot;
  robot.camera.sensor = heel::SensorKind::kRgbd;
  robot.camera.camera.left = {320, 240, 260.0, 260.0, 159.5, 119.5};
  robot.camera.T_base_camera.translation() = Eigen::Vector3d(0.0, 0.0, 1.0);
  robot.camera.is_configured = true;
  heel::Follower follower(robot, std::make_shared<heel::WallMap>(room.build()),
                          heel::loadPlan(PLANS "/search.pnml", heel::followingVocabulary()),
                          heel::FloorPose{});
  //! [robot]
  //! [exchange]
  follower.exchange(heel::FollowingAction::kSearch, std::make_unique<Wait>());
  //! [exchange]

  heel::LaserScan scan;
  scan.first_rad = -M_PI / 2.0;
  scan.step_rad = M_PI / 180.0;
  for (int i = 0; i <= 180; ++i) {
    const double angle = scan.angle(static_cast<std::size_t>(i));
    const double to_wall = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    scan.ranges_m.push_back(static_cast<float>(1.95 / to_wall));
  }
  for (int i = 0; i < 10; ++i) {
    //! [step]
    heel::RobotReadings readings;
    readings.stamp_s = 0.1 * i;
    readings.scan = &scan;
    readings.odometry = heel::FloorPose{};
    const heel::FollowStep& step = follower.step(readings);
    //! [step]
    const double off_m = step.robot.pose.position.norm();
    std::printf("%.1f s: %s, %.2f m off, %s\n", readings.stamp_s, step.state(), off_m,
                step.reason.c_str());
    const bool stands = step.velocity.forward_mps == 0.0 && step.velocity.turn_radps == 0.0;
    if (!step.is_learning || !stands || off_m > 0.1) return 1;
  }
  return 0;
}
