// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How a robot moved, from the odometry and the tf of its bag.
#pragma once

#include <heel/apps/recording/bags/bag_survey.hpp>
#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/apps/recording/robot_motion.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Finds the way through tf's tree from the robot up to the frame of its odometry, then reads what
/// moves on it.
///
/// That frame is the one that the topics name, else the one of the Odometry messages, `odom`, or
/// the parent of the base frame. Where tf does not lead there, Odometry messages do; they go first
/// if their topic is named.
class BagMotion {
 public:
  BagMotion() = default;

  /// @param camera_frame  Followed itself where it does not stand firmly in a base frame.
  /// @throws std::runtime_error  if a topic that is named is not there.
  BagMotion(const BagSurvey& survey, const BagTopics& topics, const std::string& camera_frame);

  /// Reads tf and odometry, if anything in the bag moves the robot. Absent if nothing does, but for
  /// a frame that the topics name: a robot that stands has one pose in it, at all times.
  /// @throws std::runtime_error  as openBag().
  std::optional<RobotMotion> read() const;

 private:
  struct Link {
    std::string frame, parent;
    std::optional<Eigen::Isometry3d> T_parent_frame;  // absent: it moves
  };

  void addOdometry(const BagSurvey& survey, const BagTopics& topics);
  bool findWay(const std::string& from, const BagTopics& topics);
  std::string worldFrame(const BagTopics& topics) const;
  std::map<std::string, Trajectory> readLinks() const;

  std::filesystem::path path_;
  BagQuery query_;
  std::map<std::string, BagSurvey::Link> frames_;
  std::string odometry_topic_, odometry_world_, odometry_frame_;
  Eigen::Isometry3d T_child_frame_ = Eigen::Isometry3d::Identity();  // of odometry_frame_
  std::vector<Link> way_;  // from the robot upwards; empty: nothing moves it
  RobotMotion motion_;     // without poses
};

}  // namespace heel
