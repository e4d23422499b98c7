// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the robot was, as a bag tells.
#pragma once

#include <heel/apps/recording/bags/bag_survey.hpp>
#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/mapping/floor_pose.hpp>

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Where the robot was at a moment.
struct StampedPose {
  double stamp_s = 0.0;
  FloorPose pose;
};

/// The Odometry messages that do not tell the truth: of the topic that is named, else of /odom and
/// the like, and of what sees or hears its way last. Null if there are none.
/// @throws std::runtime_error  if a topic that is named is not there.
const BagTopicSummary* findOdometry(const BagSurvey& survey, const BagTopics& topics);

/// Which of several is read, in a sentence; empty if there is one, or it is named.
std::string severalOdometries(const BagSurvey& survey, const BagTopics& topics);

/// Poses as they come in a bag's messages: the odometry, from Odometry messages or else from the
/// tf of the base frame, and the truth, from Odometry messages whose topic is named so.
class BagPoses {
 public:
  /// @throws std::runtime_error  if a topic that is named is not there.
  BagPoses(const BagSurvey& survey, const BagTopics& topics);

  bool hasOdometry() const { return !odometry_topic_.empty() || !odometry_frame_.empty(); }
  bool hasTruth() const { return !truth_topic_.empty(); }

  /// Of the Odometry messages that are taken; poses may also be in tf.
  std::vector<std::string> topics() const;

  /// Takes a message, if it holds a pose.
  void take(const BagReader& bag, const BagMessage& raw);

  /// The latest that is not younger; the oldest that is kept, if all are. Absent if there is none.
  std::optional<FloorPose> odometryAt(double stamp_s) const { return at(odometry_, stamp_s); }
  std::optional<FloorPose> truthAt(double stamp_s) const { return at(truth_, stamp_s); }

  /// The last that came, if there is one.
  const StampedPose* lastOdometry() const {
    return odometry_.empty() ? nullptr : &odometry_.back();
  }
  /// The frame of the odometry, as messages tell; empty before the first.
  const std::string& odometryFrame() const { return parent_frame_; }
  const StampedPose* lastTruth() const { return truth_.empty() ? nullptr : &truth_.back(); }

 private:
  using Poses = std::deque<StampedPose>;
  static std::optional<FloorPose> at(const Poses& poses, double stamp_s);
  static void add(Poses& poses, const StampedPose& pose);
  void takeOdometry(const BagReader& bag, const BagMessage& raw, Poses& poses);

  std::string odometry_topic_, truth_topic_;
  std::string odometry_frame_;  // the base, if tf alone has the odometry
  std::string parent_frame_;
  Poses odometry_, truth_;
  OdometryMsg message_;
  TFMessageMsg transforms_;
};

/// All poses of a bag: the truth if there is one, else the odometry.
/// @throws std::runtime_error  if there is neither.
std::vector<StampedPose> readBagPoses(const std::filesystem::path& path, const BagTopics& topics);

}  // namespace heel
