// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/param_checks.hpp>
#include <heel/apps/follower/sensor_watch.hpp>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

// A beam from which nothing came back is a reading, too.
bool isUsable(const LaserScan& scan) {
  return std::isfinite(scan.first_rad) && std::isfinite(1.0 / scan.step_rad) &&
         std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(),
                     [](float range_m) { return range_m > 0.0F; });
}

cv::Size sizeOf(const CameraSetup& setup) {
  return {setup.camera.left.width, setup.camera.left.height};
}

}  // namespace

SensorWatch::SensorWatch(const CameraSetup& camera, const SensorWatchParams& params,
                         const std::optional<CameraSetup>& floor_camera)
    : params_(params), sensor_(camera.sensor), image_size_(sizeOf(camera)) {
  if (floor_camera) floor_size_ = sizeOf(*floor_camera);
  requireNotNegative(
      "SensorWatchParams",
      {params.max_image_age_s, params.max_scan_age_s, params.max_odometry_age_s, params.max_gap_s,
       params.max_pair_gap_s, params.min_brightness, params.max_speed_mps, params.max_turn_radps});
}

RobotReadings SensorWatch::step(const RobotReadings& readings) {
  const double dt_s = begun_ ? readings.stamp_s - stamp_s_ : 0.0;
  time_jumped_ =
      !(dt_s >= 0.0 && dt_s <= params_.max_gap_s && std::isfinite(readings.stamp_s));  // NaN too
  elapsed_s_ = time_jumped_ ? 0.0 : dt_s;
  begun_ = true;
  stamp_s_ = readings.stamp_s;
  if (time_jumped_) image_clock_ = floor_clock_ = scan_clock_ = odometry_clock_ = std::nullopt;

  image_is_good_ = isUsable(readings);
  image_age_s_ =
      image_is_good_ ? ageOf(readings.frame->stamp_s, image_clock_) : image_age_s_ + elapsed_s_;

  const bool floor_is_good = floor_size_ && readings.floor != nullptr &&
                             readings.floor->depth_m.size() == *floor_size_ &&
                             readings.floor->depth_m.type() == CV_32FC1;
  floor_age_s_ =
      floor_is_good ? ageOf(readings.floor->stamp_s, floor_clock_) : floor_age_s_ + elapsed_s_;

  scan_is_good_ = readings.scan != nullptr && heel::isUsable(*readings.scan);
  scan_age_s_ = scan_is_good_ ? ageOf(readings.scan_stamp_s.value_or(readings.stamp_s), scan_clock_)
                              : scan_age_s_ + elapsed_s_;

  odometry_is_good_ = false;
  increment_ = {};
  increment_s_ = 0.0;
  last_odometry_age_s_ += elapsed_s_;
  if (readings.odometry && readings.odometry->position.allFinite() &&
      std::isfinite(readings.odometry->yaw_rad)) {
    measureIncrement(*readings.odometry,
                     ageOf(readings.odometry_stamp_s.value_or(readings.stamp_s), odometry_clock_));
  }
  odometry_age_s_ = odometry_is_good_ ? last_odometry_age_s_ : odometry_age_s_ + elapsed_s_;

  blindness_.clear();
  if (time_jumped_) blindness_ = "the clock jumped";
  if (odometry_age_s_ > params_.max_odometry_age_s) blindness_ = "no odometry";
  if (floor_size_ && floor_age_s_ > params_.max_image_age_s) blindness_ = "no image of the floor";
  if (image_age_s_ > params_.max_image_age_s) blindness_ = "no usable image";
  if (scan_age_s_ > params_.max_scan_age_s) blindness_ = "no laser scan";

  RobotReadings usable = readings;
  if (!image_is_good_) usable.frame = nullptr;
  if (!floor_is_good) usable.floor = nullptr;
  if (!scan_is_good_) usable.scan = nullptr;
  if (!odometry_is_good_) usable.odometry.reset();
  return usable;
}

// A first reading that is older than any can be has a stamp of another clock, and so have the next
// ones: they are as old as they come later than it did. So is one of the future.
double SensorWatch::ageOf(double stamp_s, std::optional<double>& clock_s) const {
  const double age_s = stamp_s_ - stamp_s;
  if (!std::isfinite(age_s)) return 0.0;
  if (!clock_s || age_s < *clock_s) clock_s = age_s;
  if (age_s >= 0.0 && age_s <= params_.max_gap_s) clock_s = 0.0;
  return age_s - *clock_s;
}

void SensorWatch::measureIncrement(const FloorPose& now, double age_s) {
  const double since_s = std::max(last_odometry_age_s_ - age_s, 0.0);
  if (odometry_) {
    const FloorPose moved = odometry_->inverse() * now;
    odometry_is_good_ = moved.position.norm() <= params_.max_speed_mps * since_s + 0.01 &&
                        std::abs(moved.yaw_rad) <= params_.max_turn_radps * since_s + 0.01;
    if (odometry_is_good_) {
      increment_ = moved;
      increment_s_ = since_s;
    }
  } else {
    odometry_is_good_ = true;
  }
  odometry_ = now;
  last_odometry_age_s_ = age_s;
}

bool SensorWatch::isUsable(const RobotReadings& readings) const {
  if (readings.frame == nullptr || !(std::abs(readings.pair_gap_s) <= params_.max_pair_gap_s)) {
    return false;
  }
  if (!fitsCamera(*readings.frame)) return false;
  const cv::Mat& image = readings.frame->image_bgr;
  if (image.empty()) return true;  // a cloud needs none
  const cv::Scalar mean = cv::mean(image);
  return (mean[0] + mean[1] + mean[2]) / 3.0 >= params_.min_brightness;
}

bool SensorWatch::fitsCamera(const Frame& frame) const {
  const auto fits = [this](const cv::Mat& image, int type) {
    return image.size() == image_size_ && image.type() == type;
  };
  switch (sensor_) {
    case SensorKind::kStereo:
      return fits(frame.image_bgr, CV_8UC3) && fits(frame.right_bgr, CV_8UC3);
    case SensorKind::kRgbd:
      return fits(frame.image_bgr, CV_8UC3) && fits(frame.depth_m, CV_32FC1);
    case SensorKind::kCloud:
      break;
  }
  return frame.cloud != nullptr;
}

}  // namespace heel
