// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Laser logs of the CARMEN toolkit.
#pragma once

#include <heel/apps/recording/laser_log.hpp>

#include <filesystem>
#include <memory>

namespace heel {

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
