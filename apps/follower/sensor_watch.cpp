// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/sensor_watch.hpp"

#include <opencv2/core.hpp>

#include <cmath>

namespace heel {

void SensorWatch::step(const RobotReadings& readings) {
  const double dt_s = begun_ ? readings.stamp_s - stamp_s_ : 0.0;
  time_jumped_ = !(dt_s >= 0.0 && dt_s <= params_.max_gap_s);  // NaN too
  const double passed_s = time_jumped_ ? 0.0 : dt_s;
  begun_ = true;
  stamp_s_ = readings.stamp_s;

  image_is_good_ = isUsable(readings);
  image_age_s_ = image_is_good_ ? 0.0 : image_age_s_ + passed_s;
  scan_age_s_ = readings.scan != nullptr ? 0.0 : scan_age_s_ + passed_s;

  odometry_is_good_ = false;
  increment_ = {};
  if (readings.odometry) {
    const FloorPose& now = *readings.odometry;
    const bool finite = now.position.allFinite() && std::isfinite(now.yaw_rad);
    if (finite && odometry_) {
      const FloorPose moved = odometry_->inverse() * now;
      const double since_s = odometry_age_s_ + passed_s;
      odometry_is_good_ = moved.position.norm() <= params_.max_speed_mps * since_s + 0.01 &&
                          std::abs(moved.yaw_rad) <= params_.max_turn_radps * since_s + 0.01;
      if (odometry_is_good_) increment_ = moved;
    }
    odometry_is_good_ = odometry_is_good_ || (finite && !odometry_);
    if (finite) odometry_ = now;
  }
  odometry_age_s_ = odometry_is_good_ ? 0.0 : odometry_age_s_ + passed_s;

  blindness_.clear();
  if (time_jumped_) blindness_ = "the clock jumped";
  if (odometry_age_s_ > params_.max_odometry_age_s) blindness_ = "no odometry";
  if (image_age_s_ > params_.max_image_age_s) blindness_ = "no usable image";
  if (scan_age_s_ > params_.max_scan_age_s) blindness_ = "no laser scan";
}

bool SensorWatch::isUsable(const RobotReadings& readings) const {
  if (readings.frame == nullptr || !(std::abs(readings.pair_gap_s) <= params_.max_pair_gap_s)) {
    return false;
  }
  const cv::Mat& image = readings.frame->image_bgr;
  if (image.empty()) return readings.frame->cloud != nullptr;
  const cv::Scalar mean = cv::mean(image);
  return (mean[0] + mean[1] + mean[2]) / 3.0 >= params_.min_brightness;
}

}  // namespace heel
