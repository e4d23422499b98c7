// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/faults.hpp>
#include <heel/apps/simulation/random.hpp>

#include <opencv2/core.hpp>

#include <algorithm>
#include <utility>

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
  if (latencies_.camera_s + latencies_.laser_s + latencies_.wheels_s > 0.0) {
    comeLate(readings.stamp_s);
  }
  return result_;
}

template <typename Reading>
void FaultySensors::Queue<Reading>::put(double comes_s, double stamp_s, Reading reading) {
  if (!on_their_way.empty()) comes_s = std::max(comes_s, on_their_way.back().comes_s);
  on_their_way.push_back({comes_s, stamp_s, std::move(reading)});
}

template <typename Reading>
bool FaultySensors::Queue<Reading>::take(double now_s) {
  constexpr double kRounding_s = 1e-6;
  come.reset();
  while (!on_their_way.empty() && on_their_way.front().comes_s <= now_s + kRounding_s) {
    come = std::move(on_their_way.front());
    on_their_way.pop_front();
  }
  return come.has_value();
}

void FaultySensors::comeLate(double now_s) {
  const auto comes_s = [&](double latency_s) {
    return now_s + (0.5 + 0.5 * uniformFrom(hashOf(seed_, ++readings_, 3))) * latency_s;
  };
  if (result_.frame != nullptr) {
    Frame frame = *result_.frame;  // The simulator's own images are of the next step by then.
    frame.image_bgr = frame.image_bgr.clone();
    frame.right_bgr = frame.right_bgr.clone();
    const double stamp_s = frame.stamp_s;
    pictures_.put(comes_s(latencies_.camera_s), stamp_s, {std::move(frame), result_.pair_gap_s});
  }
  if (result_.floor != nullptr) {
    Frame frame = *result_.floor;
    frame.depth_m = frame.depth_m.clone();
    floors_.put(comes_s(latencies_.camera_s), frame.stamp_s, std::move(frame));
  }
  if (result_.scan != nullptr) {
    scans_.put(comes_s(latencies_.laser_s), result_.stamp_s, *result_.scan);
  }
  if (result_.odometry) {
    odometries_.put(comes_s(latencies_.wheels_s), result_.stamp_s, *result_.odometry);
  }
  result_.frame = result_.floor = nullptr;
  result_.scan = nullptr;
  result_.odometry.reset();
  if (pictures_.take(now_s)) {
    result_.frame = &pictures_.come->reading.frame;
    result_.pair_gap_s = pictures_.come->reading.pair_gap_s;
  }
  if (floors_.take(now_s)) result_.floor = &floors_.come->reading;
  if (scans_.take(now_s)) {
    result_.scan = &scans_.come->reading;
    result_.scan_stamp_s = scans_.come->stamp_s;
  }
  if (odometries_.take(now_s)) {
    result_.odometry = odometries_.come->reading;
    result_.odometry_stamp_s = odometries_.come->stamp_s;
  }
}

void FaultySensors::readImages(const Readings& readings) {
  if (readings.floor_depth_m != nullptr &&
      active(Fault::Kind::kNoCamera, readings.stamp_s) == nullptr) {
    floor_.stamp_s = result_.stamp_s;
    floor_.depth_m = *readings.floor_depth_m;
    result_.floor = &floor_;
  }
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
