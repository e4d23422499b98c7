// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/faults.hpp>
#include <heel/apps/simulation/random.hpp>

#include <opencv2/core.hpp>

namespace heel {
namespace {

constexpr double kClockJump_s = 3600.0;
constexpr double kClockBack_s = 1.5;
constexpr double kSlip = 1.0 / 3.0;
constexpr double kSlipTurn_rad = 0.01;  // A step.
constexpr double kPairGap_s = 0.1;

void fillWithNoise(cv::Mat& image, std::uint64_t seed) {
  image = image.clone();
  cv::RNG random(seed);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
}

}  // namespace

const Fault* FaultySensors::active(Fault::Kind kind, double stamp_s) const {
  for (const Fault& fault : faults_) {
    if (fault.kind == kind && stamp_s >= fault.from_s && stamp_s < fault.to_s) return &fault;
  }
  return nullptr;
}

const RobotReadings& FaultySensors::read(const Readings& readings) {
  result_ = {};
  result_.stamp_s = readings.stamp_s;
  if (active(Fault::Kind::kClockJumps, readings.stamp_s) != nullptr) {
    result_.stamp_s += kClockJump_s;
  }
  if (active(Fault::Kind::kClockBack, readings.stamp_s) != nullptr) {
    result_.stamp_s -= kClockBack_s;
  }
  readImages(readings);
  readOdometry(readings);
  if (active(Fault::Kind::kNoLaser, readings.stamp_s) == nullptr) result_.scan = readings.laser;
  return result_;
}

void FaultySensors::readImages(const Readings& readings) {
  if (readings.stereo == nullptr) return;
  const double stamp_s = readings.stamp_s;
  const cv::Mat right = readings.stereo->right_bgr;
  if (active(Fault::Kind::kNoCamera, stamp_s) == nullptr) {
    ++frame_.number;
    frame_.stamp_s = result_.stamp_s;
    frame_.name = "image " + std::to_string(frame_.number);
    frame_.image_bgr = readings.stereo->left_bgr;
    frame_.right_bgr = right;
    result_.frame = &frame_;
    if (active(Fault::Kind::kPairOutOfStep, stamp_s) != nullptr && !older_right_.empty()) {
      frame_.right_bgr = older_right_;
      result_.pair_gap_s = kPairGap_s;
    }
    if (active(Fault::Kind::kLightsOut, stamp_s) != nullptr) {
      // Not zeros(): assigned, it would be written into the simulator's own image.
      frame_.image_bgr = cv::Mat(right.size(), right.type(), cv::Scalar::all(0));
      frame_.right_bgr = frame_.image_bgr;
    }
    if (active(Fault::Kind::kNoise, stamp_s) != nullptr) {
      fillWithNoise(frame_.image_bgr, hashOf(seed_, frame_.number, 1));
      fillWithNoise(frame_.right_bgr, hashOf(seed_, frame_.number, 2));
    }
  }
  for (const Fault& fault : faults_) {
    if (fault.kind == Fault::Kind::kPairOutOfStep)
      older_right_ = right.clone();  // frame_ may hold the last one
  }
}

void FaultySensors::readOdometry(const Readings& readings) {
  if (!readings.odometry) return;
  FloorPose moved;
  if (true_odometry_) moved = true_odometry_->inverse() * *readings.odometry;
  if (active(Fault::Kind::kWheelsSlip, readings.stamp_s) != nullptr) {
    moved.position *= 1.0 + kSlip;
    moved.yaw_rad += kSlipTurn_rad;
  }
  odometry_ = odometry_ ? *odometry_ * moved : *readings.odometry;
  true_odometry_ = readings.odometry;
  result_.odometry = odometry_;
}

}  // namespace heel
