// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What measures by its own light: a planar laser scanner, and a depth camera.
#pragma once

#include <heel/apps/simulation/drive_base.hpp>
#include <heel/apps/simulation/ray_world.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <opencv2/core/mat.hpp>

#include <cstdint>

namespace heel {

/// Measures into `scan`, whose memory is reused. A beam goes on through what lets it pass, and has
/// no echo of what swallows it (see LaserEcho).
/// @param geometry  What `world` was made of.
/// @param noise  Picks the noise: a number of its own for each scan.
void measureLaser(const RayWorld& world, const Geometry& geometry, const LaserParams& params,
                  const FloorPose& robot, std::uint64_t noise, LaserScan& scan);

/// The same for each pixel of a camera that looks at the floor.
/// @param depth_m  Out: CV_32FC1 along the optical axis, NaN = none.
void measureFloor(const RayWorld& world, const Geometry& geometry, const FloorCameraParams& params,
                  const FloorPose& robot, std::uint64_t noise, cv::Mat& depth_m);

}  // namespace heel
