// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_pixels.hpp"

#include <cmath>

namespace heel {

BodyPixels::BodyPixels(const BodyView& view, const WorldBlob& blob,
                       const BodyAppearanceParams& params)
    : view_(view),
      params_(params),
      T_base_camera_(view.T_base_camera.cast<float>()),
      T_camera_base_(view.T_base_camera.inverse()),
      position_m_(blob.position_m),
      top_m_(std::max(blob.max_height_m, params.least_height_m)) {}

/// Nothing if it crosses the camera's plane, or if the heights leave nothing.
cv::Rect BodyPixels::boardIn(double half_width_m, double min_height_m, double max_height_m) const {
  if (max_height_m <= min_height_m) return {};
  const Eigen::Vector2d towards = position_m_ - view_.T_base_camera.translation().head<2>();
  const double distance = std::max(towards.norm(), 1e-6);
  const Eigen::Vector2d side =
      Eigen::Vector2d(-towards.y(), towards.x()) * (half_width_m / distance);
  double u_min = 1e9, u_max = -1e9, v_min = 1e9, v_max = -1e9;
  for (const Eigen::Vector2d& foot :
       {Eigen::Vector2d(position_m_ + side), Eigen::Vector2d(position_m_ - side)}) {
    for (const double height : {min_height_m, max_height_m}) {
      const Eigen::Vector3d p = T_camera_base_ * Eigen::Vector3d(foot.x(), foot.y(), height);
      if (p.z() <= 0.1) return {};
      const double u = view_.camera.fx * p.x() / p.z() + view_.camera.cx;
      const double v = view_.camera.fy * p.y() / p.z() + view_.camera.cy;
      u_min = std::min(u_min, u);
      u_max = std::max(u_max, u);
      v_min = std::min(v_min, v);
      v_max = std::max(v_max, v);
    }
  }
  const int left = static_cast<int>(std::clamp(std::floor(u_min), -1.0, 1e6));
  const int top = static_cast<int>(std::clamp(std::floor(v_min), -1.0, 1e6));
  const int right = static_cast<int>(std::clamp(std::ceil(u_max), -1.0, 1e6)) + 1;
  const int bottom = static_cast<int>(std::clamp(std::ceil(v_max), -1.0, 1e6)) + 1;
  return cv::Rect(left, top, right - left, bottom - top) &
         cv::Rect(0, 0, view_.image_bgr.cols, view_.image_bgr.rows);
}

bool BodyPixels::isInBody(int u, int v, float z, const BodyBand& band, float& height_m) const {
  const Eigen::Vector3f in_camera((static_cast<float>(u) - static_cast<float>(view_.camera.cx)) /
                                      static_cast<float>(view_.camera.fx) * z,
                                  (static_cast<float>(v) - static_cast<float>(view_.camera.cy)) /
                                      static_cast<float>(view_.camera.fy) * z,
                                  z);
  const Eigen::Vector3f p = T_base_camera_ * in_camera;
  height_m = p.z();
  return isInCylinder(p, position_m_, band, params_.radius_m);
}

}  // namespace heel
