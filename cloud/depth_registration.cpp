// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/depth_registration.hpp>

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

/// A depth pixel covers no more colour pixels to each side: cameras that differ by more are not
/// beside each other, or not calibrated.
constexpr float kMostHalf_px = 8.0F;

/// The pixels whose middles are within `half` of `at`: from the first to one before the second.
/// None of what is no number.
cv::Range pixelsNear(float at, float half, int size) {
  const auto limit = static_cast<float>(size);
  if (!(at - half < limit && at + half > 0.0F)) return {0, 0};
  return {static_cast<int>(std::ceil(std::clamp(at - half, 0.0F, limit))),
          static_cast<int>(std::ceil(std::clamp(at + half, 0.0F, limit)))};
}

}  // namespace

DepthRegistration::DepthRegistration(const PinholeCamera& depth, const PinholeCamera& color,
                                     const Eigen::Isometry3d& T_color_depth)
    : depth_(depth),
      color_(color),
      R_color_depth_(T_color_depth.linear().cast<float>()),
      t_color_depth_(T_color_depth.translation().cast<float>()),
      half_width_(static_cast<float>(0.5 * color.fx / depth.fx)),
      half_height_(static_cast<float>(0.5 * color.fy / depth.fy)) {
  if (!isCalibrated(depth) || !isCalibrated(color)) {
    throw std::invalid_argument("DepthRegistration: a camera has no size or no focal length");
  }
  if (!T_color_depth.matrix().allFinite()) {
    throw std::invalid_argument("DepthRegistration: the pose must be finite");
  }
}

void DepthRegistration::apply(const cv::Mat& depth_m, cv::Mat& registered_m) const {
  if (depth_m.type() != CV_32FC1 || depth_m.size() != cv::Size(depth_.width, depth_.height)) {
    throw std::invalid_argument("DepthRegistration: the depth image does not fit its camera");
  }
  registered_m.create(color_.height, color_.width, CV_32FC1);
  registered_m.setTo(std::numeric_limits<float>::quiet_NaN());
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* row = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      if (!(row[u] > 0.0F)) continue;
      const Eigen::Vector3f ray(static_cast<float>((u - depth_.cx) / depth_.fx),
                                static_cast<float>((v - depth_.cy) / depth_.fy), 1.0F);
      const Eigen::Vector3f p = R_color_depth_ * (ray * row[u]) + t_color_depth_;
      const float z = p.z();
      if (!(z > 0.0F) || !p.allFinite()) continue;
      const float nearer = row[u] / z;
      const cv::Range columns =
          pixelsNear(static_cast<float>(color_.fx) * p.x() / z + static_cast<float>(color_.cx),
                     std::min(nearer * half_width_, kMostHalf_px), color_.width);
      const cv::Range rows =
          pixelsNear(static_cast<float>(color_.fy) * p.y() / z + static_cast<float>(color_.cy),
                     std::min(nearer * half_height_, kMostHalf_px), color_.height);
      for (int y = rows.start; y < rows.end; ++y) {
        auto* out = registered_m.ptr<float>(y);
        for (int x = columns.start; x < columns.end; ++x) {
          if (!(out[x] <= z)) out[x] = z;
        }
      }
    }
  }
}

bool seesTheSame(const PinholeCamera& a, const PinholeCamera& b) {
  if (a.width != b.width || a.height != b.height) return false;
  constexpr double kHalf_px = 0.5;
  const auto is_near = [](double fa, double ca, double fb, double cb, int size) {
    // Where a ray to the image's first and last pixel of one camera meets the other's image.
    return std::abs((0.0 - ca) / fa * fb + cb) < kHalf_px &&
           std::abs((size - 1.0 - ca) / fa * fb + cb - (size - 1.0)) < kHalf_px;
  };
  return is_near(a.fx, a.cx, b.fx, b.cx, a.width) && is_near(a.fy, a.cy, b.fy, b.cy, a.height);
}

}  // namespace heel
