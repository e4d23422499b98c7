// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The laser scans of a folder, as `heel simulate` writes them.
#pragma once

#include <heel/apps/recording/laser_log.hpp>

#include <fstream>
#include <memory>
#include <string>

namespace heel {

/// Reads scan.csv, odometry.csv and, if it is there, robot.csv (where the robot really was) of a
/// folder side by side; a scan's odometry and reference are the latest that are not younger than
/// it. All times must not decrease.
class SimulatedLaserLog : public LaserLog {
 public:
  /// @throws std::runtime_error  one sentence, if one of the files can't be read.
  explicit SimulatedLaserLog(const std::filesystem::path& folder);

  /// @throws std::runtime_error  one sentence with file and line, if a line is broken.
  bool next(LaserReading& reading) override;

 private:
  /// One of the files: its current line, number by number.
  struct Table {
    std::string name;
    std::ifstream in;
    std::string line;
    std::vector<double> values;
    long line_number = 1;

    void open(const std::filesystem::path& file, const std::string& header);
    bool next(std::size_t least);
  };
  /// Poses by time.
  struct Poses {
    Table table;
    FloorPose now;
    double next_s = 0.0;
    FloorPose next;
    bool more = false;

    void open(const std::filesystem::path& file, const std::string& header);
    void read();
    const FloorPose& at(double stamp_s);
  };

  Table scans_;
  Poses odometry_;
  std::unique_ptr<Poses> robot_;  // null without a truth
};

}  // namespace heel
