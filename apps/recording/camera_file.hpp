// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// camera.yaml: what a recording says about its camera.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>

namespace heel {

/// The contents of a camera.yaml; what is absent there is absent here.
struct CameraFile {
  std::optional<PinholeCamera> camera;               ///< width, height, fx, fy, cx, cy.
  std::optional<double> depth_scale;                 ///< Value of one metre in a depth image.
  std::optional<double> rate_hz;                     ///< Frames per second, where no times are.
  std::optional<Eigen::Isometry3d> T_ground_camera;  ///< Row-major 4x4 in the file.
};

/// @throws std::runtime_error  if it is not there or not YAML, a key is unknown, a value is not a
/// number or not
///         possible, some of the six intrinsics are missing, or T_ground_camera is not a rotation
///         and a translation.
CameraFile readCameraFile(const std::filesystem::path& file);

}  // namespace heel
