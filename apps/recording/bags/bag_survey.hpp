// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What is in a bag: one look at all of its messages.
#pragma once

#include <heel/apps/bag/bag.hpp>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// The messages of one topic, and what the first of them tells.
struct BagTopicSummary {
  BagTopic topic;
  bool is_known = false;  ///< We can read its messages.
  std::size_t count = 0;
  std::size_t broken = 0;  ///< Of these, whose beginning can't be read.
  /// Whether stamps are those in the messages; else when they were recorded.
  bool has_stamps = false;
  std::int64_t first_ns = 0, last_ns = 0;  ///< Least and greatest stamp.
  std::size_t backward_stamps = 0;         ///< Not later than the one before.
  /// Of images and clouds: all stamps that can be read, in seconds.
  std::vector<double> stamps_s;
  std::string frame_id;
  std::string child_frame_id;           ///< Of Odometry: whose pose it is.
  std::uint32_t width = 0, height = 0;  ///< Of images and clouds.
  std::string encoding;                 ///< Of images; "x y z rgb" of clouds.

  double duration_s() const;
  double rate_hz() const;  ///< 0 if there is none.
};

/// A bag's contents.
struct BagSurvey {
  /// Where a frame is in its parent's.
  struct Link {
    std::string parent;
    Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
    bool moves = false;
  };

  std::filesystem::path path;
  BagForm form = BagForm::kRos1;
  std::vector<BagTopicSummary> topics;
  std::map<std::string, CameraInfoMsg> camera_infos;  ///< The first of each topic.
  std::map<std::string, Link> frames;                 ///< By their names, without a leading '/'.
  std::int64_t first_ns = 0, last_ns = 0;             ///< When the first and last were recorded.
  std::size_t messages = 0;
  std::string lost;  ///< See BagReader::lost().

  /// Null if there is none.
  const BagTopicSummary* find(const std::string& topic) const;

  /// Maps points of `frame` to `base`, where none of the frames between them moves.
  std::optional<Eigen::Isometry3d> transform(const std::string& base,
                                             const std::string& frame) const;

  /// "/scan (sensor_msgs/LaserScan), /tf (tf2_msgs/TFMessage)".
  std::string topicNames() const;
};

/// Reads the whole bag.
/// @throws std::runtime_error  as openBag(); if there is no message in it.
BagSurvey surveyBag(const std::filesystem::path& path);

/// A frame's name without the '/' that old bags begin it with.
std::string frameName(const std::string& frame_id);

}  // namespace heel
