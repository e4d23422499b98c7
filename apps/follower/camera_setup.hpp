// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The camera of a recording, and whether it is set up well: what is settled before both phases.
#pragma once

#include <heel/apps/recording/recording.hpp>
#include <heel/cloud/ground_plane.hpp>
#include <heel/cloud/setup_check.hpp>
#include <heel/cloud/stereo_params.hpp>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// How the camera is found over the floor, and what is warned of.
struct CameraSetupParams {
  double look_at_s = 2.0;  ///< How much of the recording's beginning is looked at.
  /// The camera's place where the recording does not tell it; absent: the floor tells.
  std::optional<Eigen::Isometry3d> T_base_camera;
  StereoMatcherParams stereo;
  GroundPlaneParams ground;
  SetupCheckParams check;
};

/// What the beginning of a recording says of its camera.
struct CameraSetup {
  SensorKind sensor = SensorKind::kRgbd;
  StereoCamera camera;  ///< Of an organized cloud: fitted to its points. Zeros if unknown.
  /// As configured; else from the floor that was found.
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  bool is_configured = false;  ///< Where T_base_camera comes from.
  /// So high is the robot's base frame in tf over the floor: 0, or of base_link what is seen. Of
  /// T_base_camera it is taken away: its base is on the floor.
  double base_height_m = 0.0;
  std::optional<GroundPlane> ground;  ///< The floor, if one was found.
  SetupReport report;                 ///< Depth, exposure and stamps of what was looked at.
  std::vector<std::string> warnings;  ///< All that a user should know, in sentences.
};

/// Looks at the beginning of a recording that has just been opened.
/// @throws std::runtime_error  if no frame can be read, if left and right images are swapped, or if
///         the camera's place is not configured and no floor is seen.
CameraSetup findCameraSetup(Recording& recording, const CameraSetupParams& params = {});

}  // namespace heel
