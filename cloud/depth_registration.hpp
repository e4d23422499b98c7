// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The depth image of one camera as another camera beside it would see it.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// Registers depth to colour, of cameras without distortion.
///
/// Each depth covers in the colour image what its pixel covers in its own, at its new range, so
/// that a coarser depth image leaves no holes; of several, the nearest counts. What only the colour
/// camera sees has no depth. (OpenCV's rgbd::registerDepth writes beyond its memory where the depth
/// image is the larger one, up to 4.10 at least: opencv_contrib issue 3761.)
class DepthRegistration {
 public:
  /// @param T_color_depth  Maps the depth camera's optical frame to the colour camera's.
  /// @throws std::invalid_argument  if a camera has no size or focal length, or the pose is not
  ///                                finite.
  DepthRegistration(const PinholeCamera& depth, const PinholeCamera& color,
                    const Eigen::Isometry3d& T_color_depth);

  /// @param depth_m       CV_32FC1 of the depth camera's size [m]; NaN or <= 0: none.
  /// @param registered_m  Out: CV_32FC1 of the colour camera's size [m], NaN where there is none.
  /// @throws std::invalid_argument  if the image has another type or size.
  void apply(const cv::Mat& depth_m, cv::Mat& registered_m) const;

 private:
  PinholeCamera depth_, color_;
  Eigen::Matrix3f R_color_depth_;
  Eigen::Vector3f t_color_depth_;
  float half_width_, half_height_;  // of a depth pixel in the colour image, at the same range
};

/// Whether a depth image of one camera fits the pictures of another in the same place: the same
/// size, and nowhere in it half a pixel off.
bool seesTheSame(const PinholeCamera& a, const PinholeCamera& b);

}  // namespace heel
