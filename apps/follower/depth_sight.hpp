// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a depth image says of a place on the floor.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>
#include <heel/tracking/clutter_map.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <optional>

namespace heel {

/// Places are in the frame that T_camera_frame maps from: x, y on the floor, z up.
class DepthSight {
 public:
  /// @param depth_m  CV_32FC1, NaN or <= 0 where there is none; must outlive this.
  DepthSight(const cv::Mat& depth_m, const PinholeCamera& camera,
             const Eigen::Isometry3d& T_camera_frame)
      : depth_m_(depth_m), camera_(camera), T_camera_frame_(T_camera_frame) {}

  /// By three points of somebody's trunk there: depths as near to it as this may be theirs.
  Sight at(const Eigen::Vector2d& place_m, double tolerance_m = kTolerance_m) const {
    return trunkAt(place_m, tolerance_m).sight;
  }

  /// How far is seen on the way to a place: to it, or to what hides it; absent if that is not
  /// known.
  std::optional<Eigen::Vector2d> seenTo(const Eigen::Vector2d& place_m) const;

  /// Logarithm of the odds that what was observed there is a person, not a thing, by its shape: a
  /// person's trunk is not seen through, and what is as far away does not go on at both sides.
  /// @param side_m  To the left, as seen from the camera: as long as nobody's body is wide.
  /// @param depth_sigma_m  Of the depths there.
  double logPerson(const Eigen::Vector2d& place_m, const Eigen::Vector2d& side_m,
                   double depth_sigma_m) const;

 private:
  static constexpr double kTolerance_m = 0.4;
  struct Trunk {
    Sight sight;
    double nearest;  // share of the way to it, on which what hides it is
  };
  Trunk trunkAt(const Eigen::Vector2d& place_m, double tolerance_m) const;

  enum class Depth { kNone, kOutside, kNearer, kSame, kFarther };
  struct Seen {
    Depth depth;
    double share;  // of the way to the place, on which it is
  };
  Seen compare(const Eigen::Vector2d& place_m, double height_m, double tolerance_m) const;

  const cv::Mat& depth_m_;
  PinholeCamera camera_;
  Eigen::Isometry3d T_camera_frame_;
};

}  // namespace heel
