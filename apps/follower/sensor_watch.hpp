// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot's sensors bring, and whether they work: it must not move on stale or senseless
/// readings.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/recording/frame.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <opencv2/core/types.hpp>

#include <optional>
#include <string>

namespace heel {

/// What has come since the step before; a sensor of which nothing came is null or absent. All
/// stamps are of one clock.
struct RobotReadings {
  double stamp_s = 0.0;          ///< Now.
  const Frame* frame = nullptr;  ///< With the stamp of when it was taken.
  double pair_gap_s = 0.0;       ///< Between the frame's left and right image.
  const Frame* floor = nullptr;  ///< The depth of the camera that looks at the floor.
  const LaserScan* scan = nullptr;
  /// When the scan was measured; absent: RobotDescription::scan_latency_s ago.
  std::optional<double> scan_stamp_s;
  std::optional<FloorPose> odometry;  ///< In a frame of its own, drifting.
  /// When the odometry was measured; absent: RobotDescription::wheels_latency_s ago.
  std::optional<double> odometry_stamp_s;
};

/// How old readings may be before the robot stops.
struct SensorWatchParams {
  /// The robot stops when the last good image of one of its cameras is older than this.
  double max_image_age_s = 0.6;
  double max_scan_age_s = 0.35;  ///< The robot stops when the last scan is older than this.
  /// The robot stops when the last odometry is older than this.
  double max_odometry_age_s = 0.35;
  double max_gap_s = 1.0;        ///< More than this between two steps is a jump in time.
  double max_pair_gap_s = 0.02;  ///< Greatest time between the left and the right image.
  double min_brightness = 8.0;   ///< Images with a lower mean (of 256 levels) show nothing.
  double max_speed_mps = 1.5;    ///< Odometry that drives faster has slipped or been reset.
  double max_turn_radps = 4.0;   ///< Odometry that turns faster has slipped or been reset.
};

/// Looks at what came in, and when.
class SensorWatch {
 public:
  /// @param camera        What images must fit.
  /// @param floor_camera  And those of the floor; absent: none are needed.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit SensorWatch(const CameraSetup& camera, const SensorWatchParams& params = {},
                       const std::optional<CameraSetup>& floor_camera = std::nullopt);

  /// @return What of these readings can be used: a senseless one is absent, as if its sensor had
  ///         not measured.
  RobotReadings step(const RobotReadings& readings);

  /// Time since the step before; none where the clock jumped.
  double elapsed_s() const { return elapsed_s_; }
  /// How long ago the newest good reading was measured.
  double imageAge_s() const { return image_age_s_; }
  double floorAge_s() const { return floor_age_s_; }
  double scanAge_s() const { return scan_age_s_; }
  double odometryAge_s() const { return odometry_age_s_; }
  bool timeJumped() const { return time_jumped_; }
  bool imageIsGood() const { return image_is_good_; }  ///< There is one, and it can be used.
  bool scanIsGood() const { return scan_is_good_; }
  bool odometryIsGood() const { return odometry_is_good_; }
  /// How far the robot has moved since the last reading of odometry; nothing if this is not good.
  const FloorPose& increment() const { return increment_; }
  /// In this time.
  double increment_s() const { return increment_s_; }

  /// Why the robot must not move; empty if it may.
  const std::string& blindness() const { return blindness_; }

 private:
  double ageOf(double stamp_s, std::optional<double>& clock_s) const;
  bool isUsable(const RobotReadings& readings) const;
  bool fitsCamera(const Frame& frame) const;
  void measureIncrement(const FloorPose& now, double age_s);

  SensorWatchParams params_;
  SensorKind sensor_;
  cv::Size image_size_;
  std::optional<cv::Size> floor_size_;
  bool begun_ = false;
  double stamp_s_ = 0.0;
  double elapsed_s_ = 0.0;
  double image_age_s_ = 0.0, floor_age_s_ = 0.0, scan_age_s_ = 0.0, odometry_age_s_ = 0.0;
  // So far each sensor's clock is behind, once it has measured.
  std::optional<double> image_clock_, floor_clock_, scan_clock_, odometry_clock_;
  bool time_jumped_ = false;
  bool image_is_good_ = false, scan_is_good_ = false, odometry_is_good_ = false;
  std::optional<FloorPose> odometry_;  // the last that was a number, good or not,
  double last_odometry_age_s_ = 0.0;   // and its age
  FloorPose increment_;
  double increment_s_ = 0.0;
  std::string blindness_;
};

}  // namespace heel
