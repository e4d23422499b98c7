// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What is in a bag: what its index tells, and a look at the first messages.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/time_span.hpp>

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
  bool is_known = false;   ///< We can read its messages.
  std::size_t count = 0;   ///< In a part of a bag: about so many.
  std::size_t broken = 0;  ///< Of those that were looked at, whose beginning can't be read.
  /// Whether stamps are those in the messages; else when they were recorded.
  bool has_stamps = false;
  std::int64_t first_stamp_ns = 0;         ///< Of the first.
  std::int64_t first_ns = 0, last_ns = 0;  ///< When the first and last were recorded.
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
  BagQuery span;     ///< The part that was looked at; all topics.
  std::string lost;  ///< See BagReader::lost().

  /// Null if there is none.
  const BagTopicSummary* find(const std::string& topic) const;

  /// Maps points of `frame` to `base`, where none of the frames between them moves.
  std::optional<Eigen::Isometry3d> transform(const std::string& base,
                                             const std::string& frame) const;

  /// The same for any two frames that stand firmly on a third.
  std::optional<Eigen::Isometry3d> transformBetween(const std::string& to,
                                                    const std::string& from) const;

  /// The last of the frames that `frame` stands in firmly; itself, if there is none.
  std::string rootOf(const std::string& frame) const;

  /// What of the topics of these names is in the part, and tf, if `with_tf`.
  /// @param around_s  So much more before and after it.
  BagQuery queryOf(std::vector<std::string> names, bool with_tf, double around_s = 0.0) const;

  /// "/scan (sensor_msgs/LaserScan), /tf (tf2_msgs/TFMessage)".
  std::string topicNames() const;
};

/// Looks at the first message of each topic, at all of latched transforms, and at tf here and
/// there; at all messages if the bag has no index that holds.
/// @throws std::runtime_error  as openBag(); if there is no message in it, or in the span.
BagSurvey surveyBag(const std::filesystem::path& path, const TimeSpan& span = {});

/// Looks at all messages that there are now, of what is no file.
/// @param name  What errors call it.
BagSurvey surveyMessages(BagReader& reader, const std::string& name);

/// A frame's name without the '/' that old bags begin it with.
std::string frameName(const std::string& frame_id);

}  // namespace heel
