// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A video of a stereo camera that gives both images side by side, and its calibration.
#pragma once

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include <string>

namespace heel::test {

/// Of rectified images of 64x48, 0.12 m apart.
inline constexpr const char* kSideBySideRig = R"(%YAML:1.0
---
image_width: 64
image_height: 48
P1: !!opencv-matrix
   {rows: 3, cols: 4, dt: d, data: [50, 0, 31.5, 0, 0, 50, 23.5, 0, 0, 0, 1, 0]}
P2: !!opencv-matrix
   {rows: 3, cols: 4, dt: d, data: [50, 0, 31.5, -6, 0, 50, 23.5, 0, 0, 0, 1, 0]}
)";

/// A level camera, 1.2 m high.
inline constexpr const char* kLevelMounting =
    "T_ground_camera: [0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 1.2, 0, 0, 0, 1]\n";

/// Ten pictures a second: the left images are grey 50, and one more for each, the right ones 150.
inline void writeSideBySide(const std::string& file, int frames, cv::Size both = {128, 48}) {
  cv::VideoWriter writer(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 10.0,
                         both);
  EXPECT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i) {
    cv::Mat picture(both, CV_8UC3, cv::Scalar::all(150 + i));
    picture.colRange(0, both.width / 2).setTo(cv::Scalar::all(50 + i));
    writer.write(picture);
  }
}

}  // namespace heel::test
