// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Scans and odometry of a robot that has driven, one after the other.
#pragma once

#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace heel {

/// A scan and what is known of where it was taken.
struct LaserReading {
  double stamp_s = 0.0;
  LaserScan scan;
  FloorPose odometry;                  ///< Since the log's start, drifting.
  std::optional<FloorPose> reference;  ///< Truth, or another program's estimate.
};

/// A log that is read once, from its beginning to its end.
class LaserLog {
 public:
  LaserLog() = default;
  virtual ~LaserLog() = default;
  LaserLog(const LaserLog&) = delete;
  LaserLog& operator=(const LaserLog&) = delete;

  /// Reads the next scan, into memory that is reused; false at the end.
  virtual bool next(LaserReading& reading) = 0;

  /// Where the scanner is on the robot, if the log knows.
  virtual std::optional<FloorPose> T_base_scanner() const { return std::nullopt; }

  /// How high its plane is over the base frame's origin, if the log knows.
  virtual std::optional<double> scannerHeight_m() const { return std::nullopt; }

  /// What of a damaged log can't be read, in a sentence; empty: nothing.
  virtual std::string lost() const { return {}; }
};

/// Opens a folder that was recorded in simulation (see SimulatedLaserLog), a CARMEN log or a bag.
/// @throws std::runtime_error  one sentence, if it is none of them.
std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& path,
                                       const BagTopics& topics = {});

}  // namespace heel
