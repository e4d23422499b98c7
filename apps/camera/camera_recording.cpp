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
  if (!camera_->next()) {
    if (camera_->hasFailed()) throw std::runtime_error(info_.name + ": gives no more pictures");
    return false;
  }
  if (camera_->isLive()) return true;
  using Clock = std::chrono::steady_clock;
  const auto since_zero = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(camera_->stamp_s()));
  if (!zero_) zero_ = Clock::now() - since_zero;
  std::this_thread::sleep_until(*zero_ + since_zero);
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
    if (rig_->isRectified()) {
      pair[0].copyTo(frame.image_bgr);
      pair[1].copyTo(frame.right_bgr);
    } else {
      rig_->rectify(pair[0], pair[1], frame.image_bgr, frame.right_bgr);
    }
  } else {
    frame.right_bgr.release();
    frame.image_bgr = pair[0];
    depthInMetres(pair[1], depth_scale_, frame.depth_m);
  }
  return true;
}

}  // namespace heel
