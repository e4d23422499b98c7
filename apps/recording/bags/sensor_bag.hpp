// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot's sensors measured, as a bag.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// A camera's place as a message can tell it, so that a folder and a bag tell the same to the last
/// digit.
Eigen::Isometry3d asInBags(const Eigen::Isometry3d& T);

/// Writes images, scans and poses with standard messages on the usual topics:
///
/// | topic | holds |
/// | --- | --- |
/// | `/camera/{left,right}/image_rect_color/compressed` | stereo images, PNG |
/// | `/camera/{rgb/image_rect_color/compressed,depth_registered/image_rect}` | RGB-D, depth 32FC1 |
/// | `/camera/points` | clouds |
/// | `.../camera_info` | what the camera measures, at every frame |
/// | `/floor_camera/depth/image_rect` | depth 32FC1 of a camera that looks at the floor |
/// | `/scan`, `/odom` | laser ranges and wheel odometry |
/// | `/tf`, `/tf_static` | odom to base_footprint; base_footprint to the sensors; map to odom |
/// | `/ground_truth/odom`, `/ground_truth/people` | where the robot and people truly were, in map |
class SensorBag {
 public:
  /// @throws std::runtime_error  if it can't be written; so do the others.
  SensorBag(const std::filesystem::path& path, const RecordingInfo& camera);
  /// The same for any writer; images that are not packed take less time and more room.
  SensorBag(std::unique_ptr<BagWriter> bag, const RecordingInfo& camera, bool packs_images = true);

  /// Where the scanner is; before the first scan.
  void setScanner(const Eigen::Isometry3d& T_base_scanner, float max_range_m);

  void add(const Frame& frame);
  void addFloor(double stamp_s, const cv::Mat& depth_m);
  void add(double stamp_s, const LaserScan& scan);
  void addOdometry(double stamp_s, const FloorPose& odometry);
  void addTruth(double stamp_s, const FloorPose& robot, const std::vector<FloorPose>& people);

  /// Completes the bag and gives it its name.
  void commit(bool complete = true) { bag_->commit(complete); }

 private:
  HeaderMsg header(double stamp_s, const char* frame);
  void writeRaw(const std::string& topic, const HeaderMsg& header, const cv::Mat& image,
                const char* encoding);
  void writeImage(const std::string& topic, double stamp_s, const cv::Mat& image_bgr);
  void writeInfo(const std::string& topic, double stamp_s, double baseline_m);
  void writeStatic(double stamp_s);

  std::unique_ptr<BagWriter> bag_;
  RecordingInfo camera_;
  TFMessageMsg static_;
  float max_range_m_ = 0.0F;
  bool packs_images_ = true;
  bool has_static_ = false;
};

}  // namespace heel
