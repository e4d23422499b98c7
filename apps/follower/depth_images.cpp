// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_images.hpp>

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

void depthOf(const ColorCloud& cloud, cv::Mat& depth_m) {
  depth_m.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_32FC1);
  auto* depth = depth_m.ptr<float>();
  for (const auto& point : cloud) {
    *depth++ = point.z;
  }
}

}  // namespace heel
