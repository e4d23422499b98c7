// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How a camera is mounted over the floor, and where the floor is, found from the first seconds of
/// a recording.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <Eigen/Geometry>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <optional>
#include <string>

namespace heel {

/// Height and tilt of a camera. Angles are those of ROS (roll-pitch-yaw of the axes X forward, Y
/// left, Z up), 0 when it looks along the horizon.
struct Mounting {
  double height_m = 0.0;   ///< Of the optical centre over the floor.
  double pitch_rad = 0.0;  ///< > 0: it looks down.
  double roll_rad = 0.0;   ///< > 0: its right side is lower than its left.
};

/// Maps the camera's optical frame (Z forward, X right, Y down) to the base frame: origin on the
/// floor under the camera, Z up, X along the camera's heading.
Eigen::Isometry3d baseFromCamera(const Mounting& mounting);

/// The mounting of a camera whose place in a frame with Z up and z = 0 on the floor is known.
Mounting mountingOf(const Eigen::Isometry3d& T_base_camera);

/// How the floor is told from tables and walls. Defaults suit rooms and a camera on a robot or on
/// a wall that is tilted by less than 40 degrees from the guess.
struct GroundPlaneParams {
  double max_range_m = 6.0;  ///< Points further away than this are not used.
  /// The floor's points are no further than this from its plane.
  double inlier_distance_m = 0.03;
  double max_tilt_rad = 0.7;  ///< Greatest angle between the floor's normal and the guessed "up".
  double min_inlier_share = 0.05;  ///< A floor has at least this share of the points.
  std::size_t max_points = 40000;  ///< Once there are so many points, later clouds are not used.
};

/// The floor, as seen from the camera, and on what that rests.
struct GroundPlane {
  Eigen::Vector4d plane = Eigen::Vector4d::Zero();  ///< (n, d): n.p + d is the height of point p of
                                                    ///< the optical frame over the floor [m].
  Mounting mounting;                                ///< The camera over this floor.
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();  ///< baseFromCamera(mounting)
  std::size_t points = 0;                                           ///< Points that were used.
  double inlier_share = 0.0;                                        ///< Of them, on the floor.
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();         ///< Of these, in the optical frame.
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of these, about their mean.

  /// Root mean square height of these over a plane (n, d), |n| = 1 [m]; over `plane`: its noise.
  double rmsHeight(const Eigen::Vector4d& over) const;
};

/// Collects clouds and finds the floor in them by PCL's RANSAC: the largest plane that is about
/// level and has nothing below it. Deterministic.
class GroundPlaneEstimator {
 public:
  /// @param up_in_camera  A guess of "up" in the optical frame; as for a level camera by default.
  /// @throws std::invalid_argument  if a parameter is out of range or the guess is zero.
  explicit GroundPlaneEstimator(const GroundPlaneParams& params = {},
                                const Eigen::Vector3d& up_in_camera = -Eigen::Vector3d::UnitY());

  /// Adds points of a cloud in the camera's optical frame; NaN points are skipped.
  void add(const ColorCloud& cloud);

  /// Whether further clouds would change nothing.
  bool isFull() const { return points_->size() >= params_.max_points; }

  /// The floor, or nothing if no plane is like one.
  /// @param expected  Where it should be, a plane (n, d) of the optical frame: tried beside those
  ///                  that are drawn by lot, which seldom meet a floor of which little is seen.
  std::optional<GroundPlane> estimate(
      const std::optional<Eigen::Vector4d>& expected = std::nullopt) const;

 private:
  GroundPlaneParams params_;
  Eigen::Vector3d up_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points_;
};

/// A sentence that says how the floor contradicts the configured place of the camera; empty while
/// its points are no further than tolerance_m (root mean square) from where they should be: there,
/// not under the camera, of which a small patch far away says little.
std::string mountingWarning(const GroundPlane& floor, const Eigen::Isometry3d& T_base_camera,
                            double tolerance_m = 0.05);

}  // namespace heel
