// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot's sensors bring in one control step.
#pragma once

#include <heel/apps/recording/frame.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <optional>

namespace heel {

/// What is new since the step before; a sensor that did not measure is null or absent.
struct RobotReadings {
  double stamp_s = 0.0;
  const Frame* frame = nullptr;
  double pair_gap_s = 0.0;  ///< Between the frame's left and right image.
  const LaserScan* scan = nullptr;
  std::optional<FloorPose> odometry;  ///< In a frame of its own, drifting.
};

}  // namespace heel
