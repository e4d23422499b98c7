// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Scans and odometry of a robot that has driven, one after the other: of bags, CARMEN's logs and
/// simulated recordings.
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

/// Reads a CARMEN log, plain or compressed by gzip, one FLASER line after the other; memory does
/// not grow. Scans cover 180 degrees from right to left.
///
/// The pose in a FLASER line is given as the reference. ODOM lines are taken to start again from
/// that pose (as in logs that a SLAM program has corrected): the odometry is the chain of their
/// increments, without the jump to the pose.
class CarmenLog : public LaserLog {
 public:
  /// @throws std::runtime_error  one sentence, if the file can't be opened.
  explicit CarmenLog(const std::filesystem::path& file);
  ~CarmenLog() override;

  /// @throws std::runtime_error  one sentence with file and line, if a line or the compressed
  ///         stream is broken.
  bool next(LaserReading& reading) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace heel
