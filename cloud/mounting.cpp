// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/mounting.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

/// Optical axes (columns) in the axes of a camera that looks along X: forward, left, up.
Eigen::Matrix3d opticalAxes() {
  return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
}

}  // namespace

Eigen::Isometry3d baseFromCamera(const Mounting& mounting) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = mounting.height_m;
  T.linear() = Eigen::AngleAxisd(mounting.pitch_rad, Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(mounting.roll_rad, Eigen::Vector3d::UnitX()).toRotationMatrix() *
               opticalAxes();
  return T;
}

Mounting mountingOf(const Eigen::Isometry3d& T_base_camera) {
  // The base's Z in the camera's forward-left-up axes: (-sin pitch, cos pitch sin roll, cos pitch
  // cos roll).
  const Eigen::RowVector3d up = T_base_camera.linear().row(2) * opticalAxes().transpose();
  return {T_base_camera.translation().z(), std::asin(std::clamp(-up.x(), -1.0, 1.0)),
          std::atan2(up.y(), up.z())};
}

}  // namespace heel
