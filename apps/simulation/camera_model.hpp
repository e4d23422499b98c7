// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// From light to grey levels: blur, vignetting, exposure, noise, white balance and sRGB's curve.
#pragma once

#include <heel/apps/simulation/camera_light.hpp>
#include <heel/apps/simulation/random.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <vector>

namespace heel {

/// The left camera of the pair, without distortion.
PinholeCamera pinholeOf(const CameraParams& params);
PinholeCamera pinholeOf(const FloorCameraParams& params);

/// Where a camera in this place, which looks so far down, is in the base frame.
Eigen::Isometry3d mountedCamera(const Eigen::Vector3d& at, double pitch_rad);

/// Turns radiance into the picture that a camera would give.
class CameraModel {
 public:
  /// @param gamma  Exponent behind sRGB's curve.
  CameraModel(const CameraParams& params, std::uint64_t seed, double gamma = 1.0);

  /// @param radiance  CV_32FC3 of the camera's size; it is blurred in place.
  /// @param picture   Picks the noise: a number of its own for each picture.
  /// @param gain      Of this view; two cameras of a pair never agree quite.
  /// @param bgr       Out: CV_8UC3.
  void develop(cv::Mat& radiance, std::uint64_t picture, float gain, const CameraLight& light,
               cv::Mat& bgr) const;

 private:
  CameraParams params_;
  GaussianTable noise_;
  std::vector<float> vignette_;        // One factor a pixel, exposure included.
  std::vector<std::uint8_t> display_;  // sRGB's curve and the gamma, tabulated over [0, 1].
  std::vector<float> deviation_;       // Of the noise, over the same steps.
};

}  // namespace heel
