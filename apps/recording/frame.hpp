// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One moment of a recording.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <string>

namespace heel {

/// One moment of a recording; what is there depends on the sensor.
///
/// Stereo: `image_bgr` (left) and `right_bgr`. RGB-D: `image_bgr` and `depth_m`. PCD sequence:
/// `cloud` (and `image_bgr` where the cloud is organized). Images are rectified.
struct Frame {
  std::size_t number = 0;      ///< Counts from 1, as the recordings do.
  double stamp_s = 0.0;        ///< Seconds; its zero is the recording's.
  std::string name;            ///< The file that it came from, for messages.
  cv::Mat image_bgr;           ///< CV_8UC3.
  cv::Mat right_bgr;           ///< CV_8UC3, empty unless stereo.
  cv::Mat depth_m;             ///< CV_32FC1, NaN = none; empty unless RGB-D.
  ColorCloud::ConstPtr cloud;  ///< In the camera's optical frame; null unless a PCD sequence.
};

}  // namespace heel
