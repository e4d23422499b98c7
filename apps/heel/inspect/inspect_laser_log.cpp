// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/inspect/inspect.hpp>
#include <heel/apps/recording/laser_log.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>

namespace heel {

bool isLaserLogName(const std::filesystem::path& file) {
  const auto ending = (file.extension() == ".gz" ? file.stem() : file).extension();
  return ending == ".log" || ending == ".clf";
}

void inspectLaserLog(const std::filesystem::path& file) {
  const auto log = openLaserLog(file);
  LaserReading reading, first;
  std::size_t scans = 0, referenced = 0;
  double way_m = 0.0;
  FloorPose before;
  while (log->next(reading)) {
    if (scans++ == 0) first = reading;
    if (scans > 1) way_m += (reading.odometry.position - before.position).norm();
    before = reading.odometry;
    referenced += reading.reference.has_value() ? 1 : 0;
  }
  if (scans == 0)
    throw std::runtime_error(file.string() + ": holds no scans (lines of FLASER or ROBOTLASER1)");
  std::printf("laser log: %zu scan%s over %.1f s, %.1f m by its odometry\n", scans,
              scans == 1 ? "" : "s", reading.stamp_s - first.stamp_s, way_m);
  std::printf("  %zu beams, %.2f degrees apart, from %.1f degrees on\n", first.scan.ranges_m.size(),
              first.scan.step_rad * kDegrees, first.scan.first_rad * kDegrees);
  if (const auto at = log->T_base_scanner()) {
    std::printf("  scanner at (%.3f, %.3f) m on the robot, turned by %.1f degrees\n",
                at->position.x(), at->position.y(), at->yaw_rad * kDegrees);
  }
  std::printf("  %zu of them with a pose to compare with\n", referenced);
}

}  // namespace heel
