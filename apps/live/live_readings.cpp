// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/live_readings.hpp>
#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/bags/bag_recording.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace heel {

LiveReadings::LiveReadings(const BagSurvey& survey, const BagTopics& topics)
    : pose_messages_(survey.form), poses_(survey, topics), floor_topic_(topics.floor) {
  auto camera_messages = std::make_unique<FedBagReader>(survey.form);
  auto laser_messages = std::make_unique<FedBagReader>(survey.form);
  camera_messages_ = camera_messages.get();
  laser_messages_ = laser_messages.get();
  RecordingParams opening;
  opening.topics = topics;
  recording_ = BagRecording::openLive(survey, std::move(camera_messages), opening);
  laser_ = std::make_unique<BagLaserLog>(survey, std::move(laser_messages), topics);
  pose_messages_.select(survey.queryOf(poses_.topics(), true));
  for (const BagTopicSummary& t : survey.topics) {
    const std::string& name = t.topic.name;
    if (camera_messages_->wants(name) || laser_messages_->wants(name) || name == floor_topic_) {
      topics_.push_back(name);
    }
  }
}

bool LiveReadings::take(const BagTopic& topic, std::int64_t stamp_ns,
                        const std::vector<std::uint8_t>& bytes, double clock_s) {
  for (FedBagReader* reader : {camera_messages_, laser_messages_, &pose_messages_}) {
    reader->feed(topic, stamp_ns, bytes);
  }
  if (camera_messages_->wants(topic.name)) takeFrames(clock_s);
  if (topic.name == floor_topic_) takeFloor(topic, bytes, clock_s);
  return has_next_;
}

void LiveReadings::takeFloor(const BagTopic& topic, const std::vector<std::uint8_t>& bytes,
                             double clock_s) {
  const auto read = [&](auto message) {
    readMessage(pose_messages_.form(), bytes.data(), bytes.size(), message);
    floor_images_.readDepth(message, floor_.depth_m);
    floor_.stamp_s = secondsOf(message.header.stamp.ns);
  };
  has_floor_ = false;
  try {
    if (topic.holds<CompressedImageMsg>()) {
      read(CompressedImageMsg());
    } else {
      read(ImageMsg());
    }
  } catch (const std::runtime_error& error) {
    floor_skipped_.push_back({floor_skipped_.size() + 1, topic.name + ": " + error.what()});
    return;
  }
  has_floor_ = true;
  notice(floor_.stamp_s, clock_s);
}

std::vector<SkippedFrame> LiveReadings::skipped() const {
  std::vector<SkippedFrame> all = recording_->skipped();
  all.insert(all.end(), floor_skipped_.begin(), floor_skipped_.end());
  return all;
}

void LiveReadings::takeFrames(double clock_s) {
  while (recording_->next(next_frame_)) {
    if (has_next_) ++left_out_;
    has_next_ = true;
    if (next_frame_.stamp_s < last_frame_s_) {
      goes_back_ = true;
      has_time_ = false;
      now_s_ = std::numeric_limits<double>::lowest();
    }
    last_frame_s_ = next_frame_.stamp_s;
    next_came_s_ = clock_s;
    notice(next_frame_.stamp_s, clock_s);
  }
}

void LiveReadings::notice(double stamp_s, double clock_s) {
  if (has_time_ && stamp_s <= newest_s_) return;
  newest_s_ = stamp_s;
  newest_came_s_ = clock_s;
  has_time_ = true;
}

const RobotReadings& LiveReadings::read(double clock_s) {
  readings_ = {};
  has_begun_anew_ = std::exchange(goes_back_, false);
  if (has_next_) {
    std::swap(frame_, next_frame_);
    readings_.frame = &frame_;
    frame_came_s_ = next_came_s_;
    has_next_ = false;
  }
  if (std::exchange(has_floor_, false)) readings_.floor = &floor_;
  while (laser_->next(scan_)) {
    readings_.scan = &scan_.scan;
    readings_.scan_stamp_s = scan_.stamp_s;
    notice(scan_.stamp_s, clock_s);
  }
  BagMessage raw;
  bool has_moved = false;
  while (pose_messages_.next(raw)) {
    poses_.take(pose_messages_, raw);
    has_moved = true;
  }
  if (const StampedPose* odometry = poses_.lastOdometry(); has_moved && odometry != nullptr) {
    readings_.odometry = odometry->pose;
    readings_.odometry_stamp_s = odometry->stamp_s;
    notice(odometry->stamp_s, clock_s);
  }
  // A message that was late must not turn back what was reckoned before it came.
  now_s_ = std::max(now_s_, newest_s_ + (clock_s - newest_came_s_));
  readings_.stamp_s = now_s_;
  return readings_;
}

}  // namespace heel
