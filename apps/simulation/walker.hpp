// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// People who walk along their paths and step around each other and the robot.
#pragma once

#include <heel/apps/simulation/body.hpp>
#include <heel/apps/simulation/floor_plan.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace heel {

/// Someone or something that moves on the floor.
struct Mover {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double radius_m = 0.25;
};

/// Who sees the robot leaves it so much room.
inline constexpr double kRobotRoom_m = 0.05;

/// One person of a scene, living.
class Walker {
 public:
  /// @param person  Must outlive this.
  explicit Walker(const ScenePerson& person);

  /// Lives on for `dt_s` (a few hundredths of a second).
  /// @param plan    Where nobody walks.
  /// @param hiding  What is as high as the robot, and so may hide it.
  /// @param others  Everyone else, and the robot.
  /// @param robot   One of `others`: who sees it waits for it, and does not walk into it.
  void step(double dt_s, const FloorPlan& plan, const FloorPlan& hiding,
            const std::vector<Mover>& others, const Mover& robot);

  const BodyPose& pose() const { return pose_; }
  Mover mover() const { return {pose_.position, velocity_, kRadius_m}; }
  /// Whether the path has been walked to its end.
  bool done() const { return step_ >= person_->path.size(); }

 private:
  static constexpr double kRadius_m = 0.25;

  void finishStep();
  Eigen::Vector2d wayOn(double dt_s, const FloorPlan& plan);
  Eigen::Vector2d waitForRobot(double dt_s, const FloorPlan& hiding, const Eigen::Vector2d& robot);
  bool isWithRobot(const FloorPlan& hiding, const Eigen::Vector2d& robot) const;
  Eigen::Vector2d comeBack(double dt_s, const FloorPlan& hiding, const Eigen::Vector2d& robot);
  std::optional<std::size_t> walkBefore(std::size_t step) const;
  Eigen::Vector2d wayAside(const FloorPlan& plan, const Eigen::Vector2d& robot) const;
  Eigen::Vector2d chooseVelocity(const Eigen::Vector2d& wanted, const FloorPlan& plan,
                                 const std::vector<Mover>& others, const Mover* unseen) const;
  void accelerate(double dt_s, const Eigen::Vector2d& wanted);
  bool noticesRobot() const { return person_->sees_robot || feels_s_ > 0.0; }
  void keepOff(double dt_s, const Mover& robot);
  void keepOffThings(double dt_s, const FloorPlan& plan);
  void move(double dt_s);
  void turnTo(double yaw_rad, double dt_s);

  const ScenePerson* person_;
  BodyPose pose_;
  Eigen::Vector2d velocity_ = Eigen::Vector2d::Zero();
  std::size_t step_ = 0;
  double waited_s_ = 0.0;
  std::optional<std::size_t> back_to_;  // the walk to whose end they come back for the robot
  double with_robot_s_ = 0.0;           // since they did
  double makes_room_s_ = 0.0;           // still, for the robot
  double off_way_s_ = 0.0;              // since they could not go straight on.
  double stuck_s_ = 0.0;                // How long somebody has been in the way.
  double feels_s_ = 0.0;                // Still, for who bumped into the robot unseen.
};

}  // namespace heel
