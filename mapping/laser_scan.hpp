// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a planar laser scanner measures in one turn.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace heel {

/// One scan: `ranges_m[i]` is along `first_rad + i * step_rad` in the scanner's frame (X forward,
/// Y left); infinite where nothing came back, NaN where nothing could be measured.
struct LaserScan {
  double first_rad = 0.0;
  double step_rad = 0.0;
  std::vector<float> ranges_m;

  double angle(std::size_t beam) const { return first_rad + static_cast<double>(beam) * step_rad; }

  /// Which beam points along an angle: at least 0, and less than the beams of a full turn; between
  /// two beams it is no whole number.
  double beamAt(double angle_rad) const {
    const double sign = step_rad < 0.0 ? -1.0 : 1.0;
    double from_first = sign * (angle_rad - first_rad);
    from_first -= 2.0 * M_PI * std::floor(from_first / (2.0 * M_PI));
    return from_first / (sign * step_rad);
  }

  /// The index of a whole beam, that may be counted on past a full turn or back before the first
  /// one; the number of ranges where the scanner does not look.
  std::size_t index(double beam) const {
    const double turn = std::round(2.0 * M_PI / std::abs(step_rad));
    const double from_first = beam - turn * std::floor(beam / turn);
    const auto size = static_cast<double>(ranges_m.size());
    return from_first < size ? static_cast<std::size_t>(from_first) : ranges_m.size();
  }
};

}  // namespace heel
