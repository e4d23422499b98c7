// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags as recordings.
#pragma once

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_motion.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/stamp_order.hpp>
#include <heel/cloud/depth_registration.hpp>
#include <heel/cloud/stereo_rig.hpp>

#include <deque>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// The images or clouds of a bag. It is read as a stream: the next few messages, which wait for
/// their partner and tell whether a time can be, are all that is held. Two images are of one frame
/// if their stamps are less than half a frame apart.
///
/// Raw images are rectified as camera_info tells, and depth of another camera than the colour's is
/// registered to it as camera_info and tf tell; tf tells the camera's place on the robot. A bag
/// that is damaged gives what can be read, and RecordingInfo::lost tells the rest.
class BagRecording final : public Recording {
 public:
  /// @throws std::runtime_error  with one sentence that names the file and the reason.
  static std::unique_ptr<Recording> open(const std::filesystem::path& path,
                                         const RecordingParams& params);

  /// Of a robot that is on: next() gives a frame as soon as all of it has come, and false when
  /// there is none for now. It does not tell motions. Time that goes back for some frames goes on
  /// from there.
  /// @param survey  Of what has come so far.
  /// @param reader  What comes from now on.
  static std::unique_ptr<Recording> openLive(const BagSurvey& survey,
                                             std::unique_ptr<BagReader> reader,
                                             const RecordingParams& params);

  bool next(Frame& frame) override;

  std::optional<RobotMotion> readMotion() const override { return bag_motion_.read(); }

 private:
  /// A message, and its number on its topic (from 1).
  struct Waiting {
    std::size_t number = 0;
    double stamp_s = 0.0;
    std::vector<std::uint8_t> bytes;
  };
  /// A topic's messages that wait.
  struct Queue {
    std::string topic;
    bool is_compressed = false;
    bool has_stamps = true;
    std::size_t count = 0;
    std::deque<Waiting> waiting;
  };

  static std::unique_ptr<BagRecording> open(const BagSurvey& survey,
                                            std::unique_ptr<BagReader> reader,
                                            const RecordingParams& params);
  BagRecording(const BagSurvey& survey, std::unique_ptr<BagReader> reader, const BagCamera& camera,
               BagMotion motion, RecordingInfo info);

  void setUpStereo(const BagSurvey& survey, const BagCamera& camera);
  void setUpRgbd(const BagSurvey& survey, const BagCamera& camera, const BagTopics& topics);
  void setUpDepth(const BagSurvey& survey, const BagCamera& camera, const BagTopics& topics);
  bool readMessage();
  void take(const BagMessage& raw, Queue& queue);
  bool isDecided() const;
  void checkStamp(double stamp_s);
  bool beginsAnew(double stamp_s);
  std::optional<Waiting> takePartner(double stamp_s);
  void makeFrame(const Waiting& first, const Waiting* second, Frame& frame);
  void readColor(const Queue& queue, const Waiting& message, cv::Mat& image_bgr);
  void readDepth(const Waiting& message, cv::Mat& depth_m);
  void readCloud(const Waiting& message, Frame& frame);
  void checkSize(const cv::Mat& image, const PinholeCamera& camera, const char* what) const;
  std::string nameOf(const Waiting& message) const;

  std::string path_;
  std::unique_ptr<BagReader> bag_;
  BagMotion bag_motion_;
  bool is_live_ = false;
  bool at_end_ = false;
  Queue first_, second_;
  double last_s_ = -std::numeric_limits<double>::infinity();
  double older_s_ = 0.0;   // of live frames in a row that are older than that one: the last,
  std::size_t older_ = 0;  // and how many
  double limit_s_ = 0.0;   // two images of a frame are not further apart
  std::optional<StereoRig> rig_;
  cv::Mat undistort_x_, undistort_y_;  // of raw RGB-D images; empty: nothing to do
  PinholeCamera depth_camera_;         // the colour's, unless depth is registered here
  cv::Mat depth_x_, depth_y_;          // undistort depth; empty: nothing to do
  std::optional<DepthRegistration> registration_;
  cv::Mat undistorted_depth_;
  BagImageReader images_;
  ImageMsg image_;
  CompressedImageMsg compressed_;
  PointCloud2Msg cloud_;
  cv::Mat raw_left_, raw_right_;
};

}  // namespace heel
