// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_images.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {

DepthImages::DepthImages(SensorKind sensor, const StereoCamera& camera,
                         const StereoMatcherParams& params)
    : sensor_(sensor), camera_(camera), matcher_(params) {}

const cv::Mat& DepthImages::of(const Frame& frame) {
  switch (sensor_) {
    case SensorKind::kRgbd:
      return frame.depth_m;
    case SensorKind::kStereo:
      matcher_.match(frame.image_bgr, frame.right_bgr, disparity_);
      disparityToDepth(disparity_, camera_, depth_m_);
      return depth_m_;
    case SensorKind::kCloud:
      break;
  }
  if (frame.cloud == nullptr || frame.image_bgr.empty()) {
    throw std::invalid_argument("the cloud is not organized like an image");
  }
  depthOf(*frame.cloud, depth_m_);
  return depth_m_;
}

namespace {

constexpr int kCoarseWidth = 320;  // [px]

int scaleOf(const StereoCamera& camera) { return std::max(1, camera.left.width / kCoarseWidth); }

/// All that depth depends on.
StereoCamera smaller(StereoCamera camera, int scale) {
  camera.left.width /= scale;
  camera.left.height /= scale;
  camera.left.fx /= scale;
  camera.disparity_offset /= scale;
  return camera;
}

/// Distances are looked for as near as in the whole picture.
StereoMatcherParams smaller(StereoMatcherParams params, int scale) {
  constexpr int kStep = 16;  // their number is a multiple of this
  params.disparities = (params.disparities + kStep * scale - 1) / (kStep * scale) * kStep;
  return params;
}

}  // namespace

CoarseDepth::CoarseDepth(const StereoCamera& camera, const StereoMatcherParams& params)
    : camera_(smaller(camera, scaleOf(camera))), matcher_(smaller(params, scaleOf(camera))) {}

cv::Mat& CoarseDepth::of(const Frame& frame, const std::vector<cv::Rect>& parts) {
  const cv::Size whole = frame.image_bgr.size(), small(camera_.left.width, camera_.left.height);
  const double scale = static_cast<double>(small.width) / whole.width;
  parts_.create(small, CV_8UC1);
  parts_.setTo(0);
  for (const cv::Rect& part : parts) {
    if (part.empty()) continue;
    const cv::Point2d from = scale * cv::Point2d(part.tl()), to = scale * cv::Point2d(part.br());
    cv::rectangle(parts_, from, to, 255, cv::FILLED);
  }
  cv::resize(frame.image_bgr, left_, small, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(frame.right_bgr, right_, small, 0.0, 0.0, cv::INTER_AREA);
  matcher_.match(left_, right_, parts_, disparity_);
  disparityToDepth(disparity_, camera_, small_depth_m_);
  cv::resize(small_depth_m_, depth_m_, whole, 0.0, 0.0, cv::INTER_NEAREST);
  return depth_m_;
}

void depthOf(const ColorCloud& cloud, cv::Mat& depth_m) {
  depth_m.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_32FC1);
  auto* depth = depth_m.ptr<float>();
  for (const auto& point : cloud) {
    *depth++ = point.z;
  }
}

}  // namespace heel
