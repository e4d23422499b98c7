// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot sends, as the readings of a Follower.
#pragma once

#include <heel/apps/bag/fed_bag_reader.hpp>
#include <heel/apps/follower/sensor_watch.hpp>
#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/apps/recording/recording.hpp>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// Puts a robot's messages together: images to frames, scans, odometry. Which topics are the
/// robot's camera, laser and wheels, and where they are on it, is found out as of a bag.
///
/// Time is the sensors': the newest stamp, and what has passed since it came. It goes back only if
/// that of the camera's frames does for good (a simulation that is reset, a bag that is played
/// again). So the robot's clock may be another than ours, and a simulated one may be slow.
class LiveReadings {
 public:
  /// @param survey  Of what has come so far.
  /// @throws std::runtime_error  one sentence that tells the topics, if camera, scans or odometry
  ///         are missing.
  LiveReadings(const BagSurvey& survey, const BagTopics& topics);

  /// The topics that it needs; of others nothing is taken.
  const std::vector<std::string>& topics() const { return topics_; }
  /// Of the camera.
  const RecordingInfo& info() const { return recording_->info(); }
  const LaserLog& laser() const { return *laser_; }
  /// The frame of the odometry; empty before the first.
  const std::string& odometryFrame() const { return poses_.odometryFrame(); }

  /// Takes in a message.
  /// @param clock_s  Now, on any clock of ours that does not jump.
  /// @return  Whether there is a frame that was not read yet.
  bool take(const BagTopic& topic, std::int64_t stamp_ns, const std::vector<std::uint8_t>& bytes,
            double clock_s);

  /// The newest of each that has come since the last time; valid until the next time.
  const RobotReadings& read(double clock_s);

  /// Whether time had gone back before the last readings: what was before is of no use.
  bool hasBegunAnew() const { return has_begun_anew_; }

  /// How long ago the frame of the last readings came [s].
  double frameAge_s(double clock_s) const { return clock_s - frame_came_s_; }
  /// Frames that were left out, as a newer one had come.
  std::size_t framesLeftOut() const { return left_out_; }
  /// The camera's frames, then the floor's images, that could not be read.
  std::vector<SkippedFrame> skipped() const;

 private:
  void notice(double stamp_s, double clock_s);
  void takeFrames(double clock_s);
  void takeFloor(const BagTopic& topic, const std::vector<std::uint8_t>& bytes, double clock_s);

  FedBagReader* camera_messages_ = nullptr;  // the recording's,
  FedBagReader* laser_messages_ = nullptr;   // and the laser's
  FedBagReader pose_messages_;
  std::unique_ptr<Recording> recording_;
  std::unique_ptr<LaserLog> laser_;
  BagPoses poses_;
  std::vector<std::string> topics_;
  std::string floor_topic_;
  BagImageReader floor_images_;
  std::vector<SkippedFrame> floor_skipped_;
  Frame frame_, next_frame_, floor_;
  bool has_floor_ = false;
  bool has_next_ = false;
  bool goes_back_ = false, has_begun_anew_ = false;  // the next readings, and the last
  double last_frame_s_ = std::numeric_limits<double>::lowest();
  LaserReading scan_;
  RobotReadings readings_;
  double now_s_ = std::numeric_limits<double>::lowest();
  double newest_s_ = 0.0;       // stamp, and
  double newest_came_s_ = 0.0;  // when that came
  double next_came_s_ = 0.0, frame_came_s_ = 0.0;
  bool has_time_ = false;
  std::size_t left_out_ = 0;
};

}  // namespace heel
