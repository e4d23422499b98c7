// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One scan as other scanners send it.
#pragma once

#include <heel/mapping/laser_scan.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heel::test {

/// The scan itself; with angles from 0 to a full turn instead of from half a turn before; and from
/// left to right.
inline std::vector<LaserScan> sameScans(const LaserScan& scan) {
  std::vector<LaserScan> scans(3, scan);
  scans[1].first_rad += 2.0 * M_PI;
  scans[2].first_rad = scan.angle(scan.ranges_m.size() - 1);
  scans[2].step_rad = -scan.step_rad;
  std::reverse(scans[2].ranges_m.begin(), scans[2].ranges_m.end());
  return scans;
}

}  // namespace heel::test
