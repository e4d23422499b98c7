// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A planar laser scanner.
#pragma once

#include <heel/apps/simulation/drive_base.hpp>
#include <heel/apps/simulation/ray_world.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <cstdint>

namespace heel {

/// Measures into `scan`, whose memory is reused. A beam goes on through what lets it pass, and has
/// no echo of what swallows it (see LaserEcho).
/// @param geometry  What `world` was made of.
/// @param noise  Picks the noise: a number of its own for each scan.
void measureLaser(const RayWorld& world, const Geometry& geometry, const LaserParams& params,
                  const FloorPose& robot, std::uint64_t noise, LaserScan& scan);

}  // namespace heel
