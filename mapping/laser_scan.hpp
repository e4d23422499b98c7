// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a planar laser scanner measures in one turn.
#pragma once

#include <vector>

namespace heel {

/// One scan: `ranges_m[i]` is along `first_rad + i * step_rad` in the scanner's frame (X forward,
/// Y left); infinite where nothing came back.
struct LaserScan {
  double first_rad = 0.0;
  double step_rad = 0.0;
  std::vector<float> ranges_m;

  double angle(std::size_t beam) const { return first_rad + static_cast<double>(beam) * step_rad; }
};

}  // namespace heel
