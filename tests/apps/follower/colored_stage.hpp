// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The small stage, in colours.
#pragma once

#include "tests/apps/follower/acted_scene.hpp"
#include "tests/segmentation/painted_person.hpp"
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/laser_bodies.hpp>
#include <heel/apps/recording/frame.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace heel::test {

inline constexpr Bgr kTrousers{90, 60, 30};

/// The small stage, in colours; people are rounded towards the camera, as bodies are.
struct ColoredStage : ActedScene {
  ColoredStage() { image.setTo(cv::Scalar(kFloor.b, kFloor.g, kFloor.r)); }

  /// Draws what stands at (x, y), from one height to another.
  ColoredStage& part(double x, double y, double half_width_m, double low_m, double high_m,
                     Bgr color) {
    const auto column = [&](double left) { return camera.cx - camera.fx * left / x; };
    const auto row = [&](double z) { return camera.cy - camera.fy * (z - 1.0) / x; };
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        if (v <= row(high_m) || v > row(low_m)) continue;
        const double across = 2.0 * (u - column(y)) / (column(y - 1.0) - column(y + 1.0));
        if (std::abs(across) > half_width_m) continue;
        image.at<cv::Vec3b>(v, u) = {color.b, color.g, color.r};
        const double off = across / half_width_m;
        depth.at<float>(v, u) = static_cast<float>(x + 0.2 * (off * off - 1.0 / 3.0));
      }
    }
    return *this;
  }

  ColoredStage& person(double x, double y, Bgr jumper) {
    part(x, y, 0.2, 0.0, 0.9, kTrousers);
    part(x, y, 0.2, 0.9, 1.45, jumper);
    return part(x, y, 0.1, 1.45, 1.75, kSkin);
  }

  ColoredStage& person(double x, double y) { return person(x, y, kRed); }

  Frame frame(double stamp_s) const {
    Frame frame;
    frame.stamp_s = stamp_s;
    frame.image_bgr = image;
    frame.depth_m = depth;
    return frame;
  }

  ColorCloud::Ptr cloud() const {
    ColorCloud::Ptr cloud(new ColorCloud);
    makeColorCloud(depth, image, camera, Eigen::Isometry3d::Identity(), *cloud);
    return cloud;
  }
};

/// A laser at the base's origin that sees a leg at these places, and nothing else.
inline LaserScan scanOf(const std::vector<Eigen::Vector2d>& places_m) {
  LaserScan scan;
  scan.first_rad = -3.14;
  scan.step_rad = 0.01;
  scan.ranges_m.assign(628, std::numeric_limits<float>::infinity());
  for (const Eigen::Vector2d& place : places_m) {
    const double beam = (std::atan2(place.y(), place.x()) - scan.first_rad) / scan.step_rad;
    for (int i = -2; i <= 2; ++i) {
      scan.ranges_m[static_cast<std::size_t>(std::lround(beam) + i)] =
          static_cast<float>(place.norm());
    }
  }
  return scan;
}

inline LaserBodies legsAt(const std::vector<Eigen::Vector2d>& places_m) {
  const LaserScan scan = scanOf(places_m);
  LaserBodies legs;
  legs.step(
      &scan, {}, [](const Eigen::Vector2d&) { return 9.0; }, 0.1);
  return legs;
}

}  // namespace heel::test
