// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Does the camera stand still? As far as its depth images tell.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <optional>

namespace heel {

/// When the scene is no longer that of the first image.
///
/// People who walk change depth where they are, a camera that moves nearly everywhere. So the
/// camera has moved where in each third of the image, left, middle and right, most of what has a
/// depth differs, and does so for some time.
struct StillCheckParams {
  double period_s = 1.0;  ///< An image is looked at this often.
  /// Lower points are left out: the floor looks the same from everywhere.
  double min_height_m = 0.2;
  /// Higher points are left out: the ceiling looks the same from everywhere.
  double max_height_m = 2.0;
};

/// Compares the depth images of a recording with its first.
class StillCheck {
 public:
  /// @param inverse_depth_sigma  Of the noise of 1 / depth [1/m]; 0 if it is small.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  StillCheck(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
             double inverse_depth_sigma, const StillCheckParams& params = {});

  /// Whether it is time to look at an image, so that others need no depth.
  bool isDue(double stamp_s) const;

  /// @param depth_m  CV_32FC1 of the camera's size, NaN or <= 0 where there is none.
  /// @throws std::invalid_argument  if the image does not fit.
  void add(double stamp_s, const cv::Mat& depth_m);

  /// From when on the scene was another; absent if it was not.
  std::optional<double> leaves_s() const { return leaves_s_; }

 private:
  bool isAnother(const cv::Mat& depth_m) const;
  bool isAtBodyHeight(int u, int v, double depth_m) const;

  PinholeCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  StillCheckParams params_;
  double step_;
  cv::Mat first_m_;
  double last_s_ = 0.0;
  int others_ = 0;         // in a row, ...
  double others_s_ = 0.0;  // and since when
  std::optional<double> leaves_s_;
};

}  // namespace heel
