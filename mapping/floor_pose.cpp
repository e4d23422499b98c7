// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/floor_pose.hpp>

#include <cmath>

namespace heel {

FloorPose FloorPose::operator*(const FloorPose& next) const {
  return {*this * next.position, wrapped(yaw_rad + next.yaw_rad)};
}

FloorPose FloorPose::inverse() const {
  return {-(Eigen::Rotation2Dd(-yaw_rad) * position), wrapped(-yaw_rad)};
}

double wrapped(double angle_rad) {
  constexpr double kTwoPi = 2.0 * M_PI;
  return std::remainder(angle_rad, kTwoPi);
}

Eigen::Isometry3d basePose(const FloorPose& pose) {
  return Eigen::Translation3d(pose.position.x(), pose.position.y(), 0.0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(pose.yaw_rad, Eigen::Vector3d::UnitZ()));
}

FloorPose alongArc(const FloorPose& pose, double distance_m, double turn_rad) {
  // The chord of an arc points along its middle heading.
  const double half = turn_rad / 2.0;
  const double chord = distance_m * (std::abs(half) < 1e-9 ? 1.0 : std::sin(half) / half);
  const double heading = pose.yaw_rad + half;
  return {pose.position + chord * Eigen::Vector2d(std::cos(heading), std::sin(heading)),
          wrapped(pose.yaw_rad + turn_rad)};
}

double bearingOf(const FloorPose& from, const Eigen::Vector2d& place) {
  const Eigen::Vector2d way = from.inverse() * place;
  return std::atan2(way.y(), way.x());
}

}  // namespace heel
