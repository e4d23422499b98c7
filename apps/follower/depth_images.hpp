// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Colour and depth of a frame, whatever the sensor.
#pragma once

#include <heel/apps/recording/recording.hpp>
#include <heel/cloud/stereo_matcher.hpp>

#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// The depth image of an organized cloud in the optical frame.
/// @param depth_m  Out: CV_32FC1; its memory is reused.
void depthOf(const ColorCloud& cloud, cv::Mat& depth_m);

/// Gives every pixel's depth: matched from a stereo pair, as measured by an RGB-D camera, or taken
/// from an organized cloud. From here on phase 1 does not know the sensor. Reuses its memory.
class DepthImages {
 public:
  DepthImages(SensorKind sensor, const StereoCamera& camera,
              const StereoMatcherParams& params = {});

  /// @return  CV_32FC1, metres along the optical axis, NaN (or <= 0) where there is none; valid
  ///          until the next call.
  /// @throws std::invalid_argument  if the frame has not what its sensor gives (a cloud that is not
  ///         organized, say).
  const cv::Mat& of(const Frame& frame);

 private:
  SensorKind sensor_;
  StereoCamera camera_;
  StereoMatcher matcher_;
  cv::Mat disparity_;
  cv::Mat depth_m_;
};

/// Depth of all colours, of a stereo pair, in parts of the image only: whatever stands in front of
/// a body is not its own. That needs no fine picture: a wide one is made smaller, down to 320
/// pixels.
class CoarseDepth {
 public:
  explicit CoarseDepth(const StereoCamera& camera, const StereoMatcherParams& params = {});

  /// @param parts  Clipped to the image.
  /// @return  As DepthImages::of(), NaN outside the parts; it may be written to.
  cv::Mat& of(const Frame& frame, const std::vector<cv::Rect>& parts);

 private:
  StereoCamera camera_;  // of the small pictures
  StereoMatcher matcher_;
  cv::Mat left_, right_, parts_, disparity_, small_depth_m_;
  cv::Mat depth_m_;
};

}  // namespace heel
