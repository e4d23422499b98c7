// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The laser scans of a bag.
#pragma once

#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/laser_log.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Reads the LaserScan messages of one topic, with the latest odometry and truth at each. Scans are
/// as those of a scanner that stands upright and turns to the left, with angles in [-pi, pi),
/// whatever the bag's is. What could not be measured is NaN (REP 117).
class BagLaserLog : public LaserLog {
 public:
  /// @throws std::runtime_error  one sentence that names the topics, if scans or odometry are
  ///         missing.
  BagLaserLog(const std::filesystem::path& path, const BagTopics& topics);
  /// Of what the reader gives, which may go on after next() was false.
  BagLaserLog(const BagSurvey& survey, std::unique_ptr<BagReader> reader, const BagTopics& topics);

  bool next(LaserReading& reading) override;
  std::optional<FloorPose> T_base_scanner() const override { return T_base_scanner_; }
  std::optional<double> scannerHeight_m() const override { return scanner_height_m_; }
  std::string unplaced() const override { return unplaced_; }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::string lost() const override { return lost_; }

 private:
  void place(const BagSurvey& survey, const BagTopics& topics, const std::string& frame);
  std::unique_ptr<BagReader> bag_;
  std::optional<BagPoses> poses_;
  std::optional<FloorPose> T_base_scanner_;
  std::optional<double> scanner_height_m_;
  bool is_upside_down_ = false;
  std::vector<std::string> warnings_;
  std::string scan_topic_, unplaced_, lost_;
  bool has_stamps_ = true;
  LaserScanMsg scan_;
};

}  // namespace heel
