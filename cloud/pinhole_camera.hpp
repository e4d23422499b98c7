// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A rectified pinhole camera.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace heel {

/// Intrinsics of a rectified camera without distortion, in pixels.
///
/// Optical frame: Z forward, X right, Y down; u = fx X / Z + cx, v = fy Y / Z + cy.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
};

/// Whether points and pixels can be turned into each other: it has a size, positive focal lengths,
/// and all of it is finite.
inline bool isCalibrated(const PinholeCamera& camera) {
  return camera.width > 0 && camera.height > 0 && camera.fx > 0.0 && camera.fy > 0.0 &&
         std::isfinite(camera.fx) && std::isfinite(camera.fy) && std::isfinite(camera.cx) &&
         std::isfinite(camera.cy);
}

/// Where a point (of the optical frame, Z > 0) is seen [px].
inline Eigen::Vector2d project(const PinholeCamera& camera, const Eigen::Vector3d& point) {
  return {camera.fx * point.x() / point.z() + camera.cx,
          camera.fy * point.y() / point.z() + camera.cy};
}

/// What is seen at a pixel is along this: the point of the optical frame at Z = 1.
inline Eigen::Vector3d rayOf(const PinholeCamera& camera, double u, double v) {
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0};
}

/// A rectified stereo pair: the left camera, and what turns a disparity into a depth.
///
/// Z = fx * baseline_m / (disparity + disparity_offset), with disparity = u_left - u_right.
struct StereoCamera {
  PinholeCamera left;
  double baseline_m = 0.0;        ///< Distance between the two centres, > 0.
  double disparity_offset = 0.0;  ///< cx_right - cx_left [px] ("doffs"); 0 for parallel views.
};

}  // namespace heel
