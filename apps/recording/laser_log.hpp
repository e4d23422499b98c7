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
#include <vector>

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

  /// Why the log does not know where the scanner is though it might, in a sentence; else empty.
  virtual std::string unplaced() const { return {}; }

  /// What a user should know of how it is read, in sentences.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// What of a damaged log can't be read, in a sentence; empty: nothing.
  virtual std::string lost() const { return {}; }
};

/// Opens a folder that was recorded in simulation (see SimulatedLaserLog), a CARMEN log or a bag.
/// @throws std::runtime_error  one sentence, if it is none of them.
std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& path,
                                       const BagTopics& topics = {});

/// Reads a CARMEN log, plain or compressed by gzip, one scan after the other; memory does not grow.
/// Scans are lines of FLASER (180 degrees from right to left) or ROBOTLASER1, whichever comes
/// first. Each has two poses, of the laser and of the robot. What they are differs from log to log,
/// and is found in the log:
///
/// - Where the one is at the same place from the other in all scans, that is the scanner's place,
///   and the pose belongs to the odometry. There is no reference; without ODOM lines the pose is
///   taken for one.
/// - If ODOM lines lead elsewhere, faster than any robot, before most scans, a SLAM program has
///   corrected the log: the robot's pose is the reference, and ODOM lines start again from it. The
///   odometry is the chain of their increments, without the jump to the pose.
/// - Where the one is not at the same place from the other, the laser's is the reference; it is
///   robot_frontlaser_offset before the base.
class CarmenLog : public LaserLog {
 public:
  /// @throws std::runtime_error  one sentence, if the file can't be opened, or if lines or the
  ///         compressed stream are broken and no scan is whole.
  explicit CarmenLog(const std::filesystem::path& file);
  ~CarmenLog() override;

  /// Lines that are broken are left out.
  bool next(LaserReading& reading) override;
  std::string lost() const override { return lost_; }

  std::optional<FloorPose> T_base_scanner() const override { return T_base_scanner_; }

 private:
  enum class Reference { kNone, kRobot, kLaser };
  struct State;
  std::unique_ptr<State> state_;
  Reference reference_ = Reference::kNone;
  FloorPose T_base_scanner_;
  std::string lost_;
};

}  // namespace heel
