// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/camera_recording.hpp>
#include <heel/apps/recording/image_file.hpp>

#include <stdexcept>
#include <thread>

namespace heel {

CameraRecording::CameraRecording(const PairCameraParams& params) : camera_(openPairCamera(params)) {
  info_.name = camera_->name();
  info_.layout = camera_->isLive() ? "camera" : "video of a camera";
  info_.sensor = camera_->kind();
  if (!camera_->warning().empty()) info_.warnings.push_back(camera_->warning());
  if (!awaitPair()) throw std::runtime_error(camera_->name() + ": gives no pictures");
  has_first_ = true;
  PairCalibration calibration = camera_->calibration();
  info_.T_base_camera = calibration.file.T_ground_camera;
  if (camera_->kind() == SensorKind::kRgbd) {
    info_.camera.left = calibration.file.camera.value();
    depth_scale_ = calibration.file.depth_scale.value();
    return;
  }
  if (!calibration.rig) {
    throw std::runtime_error(camera_->name() + ": a stereo camera needs its --calibration");
  }
  rig_ = std::move(calibration.rig);
  info_.camera = rig_->camera();
}

bool CameraRecording::awaitPair() {
  double last_s = camera_->stamp_s();
  do {
    if (!camera_->next()) {
      if (camera_->hasFailed()) throw std::runtime_error(info_.name + ": gives no more pictures");
      return false;
    }
  } while (began_ && !(camera_->stamp_s() > last_s && camera_->stamp_s() < kLongestVideo_s));
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since_first(began_ ? camera_->stamp_s() : 0.0);
  if (!began_) began_ = now;
  if (!camera_->isLive()) {
    using Ticks = std::chrono::steady_clock::duration;
    std::this_thread::sleep_until(*began_ + std::chrono::duration_cast<Ticks>(since_first));
  }
  return true;
}

bool CameraRecording::next(Frame& frame) {
  if (!has_first_ && !awaitPair()) return false;
  has_first_ = false;
  const std::array<cv::Mat, 2> pair = camera_->pictures();
  frame.number = ++count_;
  frame.stamp_s = camera_->stamp_s();
  frame.name = info_.name;
  frame.cloud.reset();
  if (rig_) {
    frame.depth_m.release();
    rig_->rectify(pair[0], pair[1], frame.image_bgr, frame.right_bgr);
  } else {
    frame.right_bgr.release();
    frame.image_bgr = pair[0];
    depthInMetres(pair[1], depth_scale_, frame.depth_m);
  }
  return true;
}

}  // namespace heel
