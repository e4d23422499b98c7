// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/still_check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace heel {
namespace {

// The camera has moved if so many images, one after the other, show another scene.
constexpr int kConfirmImages = 3;
// A third of the image shows another scene if this share of its points differs: people together
// change half.
constexpr double kMinShare = 0.65;
constexpr double kMinKnown = 0.05;  // A third in which fewer have a depth in both is not looked at.
// A change of inverse depth counts from this on [1/m], as for people, and only from so many of its
// own standard deviations on.
constexpr double kMinStep = 0.02;
constexpr double kNoiseSigmas = 3.0;

constexpr int kStride = 4;  // Every so many pixels, both ways.
constexpr int kThirds = 3;

}  // namespace

StillCheck::StillCheck(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                       double inverse_depth_sigma, const StillCheckParams& params)
    : camera_(camera),
      T_base_camera_(T_base_camera),
      params_(params),
      step_(std::max(kMinStep, kNoiseSigmas * inverse_depth_sigma)) {
  if (!(params.period_s > 0.0 && step_ > 0.0 && params.min_height_m < params.max_height_m)) {
    throw std::invalid_argument("StillCheckParams: a parameter is not positive");
  }
}

bool StillCheck::isDue(double stamp_s) const {
  return !leaves_s_ && (first_m_.empty() || stamp_s >= last_s_ + params_.period_s);
}

void StillCheck::add(double stamp_s, const cv::Mat& depth_m) {
  if (depth_m.type() != CV_32FC1 || depth_m.cols != camera_.width ||
      depth_m.rows != camera_.height) {
    throw std::invalid_argument("StillCheck: the depth image does not fit the camera");
  }
  if (leaves_s_) return;
  last_s_ = stamp_s;
  if (first_m_.empty()) {
    first_m_ = depth_m.clone();
  } else if (!isAnother(depth_m)) {
    others_ = 0;
  } else {
    if (others_++ == 0) others_s_ = stamp_s;
    if (others_ >= kConfirmImages) leaves_s_ = others_s_;
  }
}

bool StillCheck::isAnother(const cv::Mat& depth_m) const {
  std::array<int, kThirds> all{}, known{}, changed{};
  for (int v = 0; v < depth_m.rows; v += kStride) {
    const auto* now = depth_m.ptr<float>(v);
    const auto* first = first_m_.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; u += kStride) {
      const auto third = static_cast<std::size_t>(kThirds * u / depth_m.cols);
      ++all[third];
      const auto now_m = static_cast<double>(now[u]), first_m = static_cast<double>(first[u]);
      if (!(now_m > 0.0 && first_m > 0.0) || !isAtBodyHeight(u, v, first_m)) continue;
      ++known[third];
      if (std::abs(1.0 / now_m - 1.0 / first_m) > step_) ++changed[third];
    }
  }
  int thirds = 0;
  for (std::size_t i = 0; i < kThirds; ++i) {
    if (known[i] < kMinKnown * all[i]) continue;
    if (changed[i] <= kMinShare * known[i]) return false;
    ++thirds;
  }
  return thirds >= 2;
}

bool StillCheck::isAtBodyHeight(int u, int v, double depth_m) const {
  const double height_m = (T_base_camera_ * Eigen::Vector3d(rayOf(camera_, u, v) * depth_m)).z();
  return height_m > params_.min_height_m && height_m < params_.max_height_m;
}

}  // namespace heel
