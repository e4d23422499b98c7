// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A planar laser scanner.
#pragma once

#include "apps/simulation/drive_base.hpp"
#include "apps/simulation/ray_world.hpp"

#include <cstdint>
#include <vector>

namespace heel {

/// One scan: `ranges_m[i]` is along `first_rad + i * step_rad` in the scanner's frame, which is the
/// robot's, moved; infinite where nothing came back.
struct LaserScan {
  double first_rad = 0.0;
  double step_rad = 0.0;
  std::vector<float> ranges_m;
};

/// Measures into `scan`, whose memory is reused.
/// @param noise  Picks the noise: a number of its own for each scan.
void measureLaser(const RayWorld& world, const LaserParams& params, const FloorPose& robot,
                  std::uint64_t noise, LaserScan& scan);

}  // namespace heel
