// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A calibrated pair of cameras: how its images are rectified, and what they measure then.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <opencv2/core/mat.hpp>

#include <string>

namespace heel {

/// One camera as calibrated: u = K distort(X / Z, Y / Z), by OpenCV's model or its fisheye model.
struct RawCamera {
  cv::Mat K;                ///< 3x3, CV_64F.
  cv::Mat distortion;       ///< 1xN, N = 4, 5, 8, 12 or 14 (fisheye: 4), CV_64F; empty: none.
  cv::Mat R;                ///< 3x3: rotates the camera's frame into the rectified one.
  cv::Mat P;                ///< 3x4: projects the rectified frame.
  bool is_fisheye = false;  ///< Whether the distortion is that of the fisheye model.
};

/// Sets a camera's distortion by the name that ROS has for its model: plumb_bob (also without a
/// name), rational_polynomial, or equidistant, which is the fisheye model. Where all numbers are 0
/// there is none, whatever the model, as ROS has it.
/// @throws std::runtime_error  one sentence that begins with `origin`, if the model is not known.
void setDistortion(const std::string& origin, const std::string& model, const cv::Mat& numbers,
                   RawCamera& camera);

/// @throws std::runtime_error  one sentence that begins with `origin`, if a camera has a distortion
///         of so many numbers as OpenCV has no model for.
void checkDistortion(const std::string& origin, const RawCamera& camera);

/// Makes the maps by which cv::remap rectifies a camera's images.
/// @param type  Of the first map: CV_16SC2 or CV_32FC1.
void makeRectifyMaps(const RawCamera& camera, cv::Size image_size, int type, cv::Mat& first,
                     cv::Mat& second);

/// Two calibrated cameras. Immutable once made; `const` members are thread-safe.
class StereoRig {
 public:
  /// Cameras whose rectification is known (R and P are set; the right P has the baseline).
  /// @param origin  Where the figures come from, for messages: a file's name.
  /// @throws std::runtime_error  with one sentence, if there is no baseline, the cameras are
  ///         swapped or stand above each other, the size is not given, or a distortion is not
  ///         known.
  StereoRig(RawCamera left, RawCamera right, cv::Size image_size, const std::string& origin);

  /// Images that are rectified already.
  /// @throws std::invalid_argument  if there is no baseline.
  explicit StereoRig(const StereoCamera& camera);

  /// What rectified images measure.
  const StereoCamera& camera() const { return camera_; }

  /// Whether images come rectified, so that `rectify` has nothing to do.
  bool isRectified() const { return left_map_.empty(); }

  /// Rectifies a raw pair; hands the very images on if they are rectified already.
  /// @throws std::invalid_argument  if an image is not of the calibrated size.
  void rectify(const cv::Mat& left, const cv::Mat& right, cv::Mat& rectified_left,
               cv::Mat& rectified_right) const;

 private:
  StereoCamera camera_;
  cv::Mat left_map_, left_weights_, right_map_, right_weights_;  // empty: rectified already
};

}  // namespace heel
