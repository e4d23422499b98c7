// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A small RGB-D stage: a grey wall, and people as upright boards before it.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <cmath>

namespace heel::test {

/// What a camera 1 m over the floor, looking ahead, sees of the stage.
struct ActedScene {
  static constexpr int kWall = 150;  ///< Its intensity; it stands at x = 5 m.

  PinholeCamera camera{160, 120, 131.25, 131.25, 79.5, 59.5};
  cv::Mat image = cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(kWall));
  cv::Mat depth = cv::Mat(120, 160, CV_32FC1, cv::Scalar::all(5.0));

  static Eigen::Isometry3d T_base_camera() {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    T.translation() << 0, 0, 1.0;
    return T;
  }

  /// The pixels of a board 0.4 m wide and 1.75 m high that stands at (x, y), facing the camera.
  cv::Rect board(double x, double y) const {
    const auto column = [&](double left) {
      return static_cast<int>(std::lround(camera.cx - camera.fx * left / x));
    };
    const auto row = [&](double z) {
      return static_cast<int>(std::lround(camera.cy - camera.fy * (z - 1.0) / x));
    };
    return cv::Rect(cv::Point(column(y + 0.2), row(1.75)), cv::Point(column(y - 0.2), row(0.0))) &
           cv::Rect(0, 0, camera.width, camera.height);
  }

  ActedScene& person(double x, double y, int intensity = 30) {
    image(board(x, y)).setTo(cv::Scalar::all(intensity));
    depth(board(x, y)).setTo(x);
    return *this;
  }
};

}  // namespace heel::test
