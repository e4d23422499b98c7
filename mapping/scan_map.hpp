// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A floor map from laser scans whose places are known.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <cstdint>
#include <vector>

namespace heel {

/// When a cell is free or occupied.
struct ScanMapParams {
  double cell_size_m = 0.05;  ///< Edge of a cell.
  double max_range_m = 20.0;  ///< Longer beams clear cells up to here, and end nowhere.
};

/// Counts, cell by cell, the beams that ended in it and those that went through it (the counting
/// model of Haehnel and others; it forgets nothing, so that what moves is outvoted). Beams without
/// an echo are left out. Grows as the robot goes.
class ScanMap {
 public:
  /// @throws std::invalid_argument  if a parameter is out of range.
  explicit ScanMap(const ScanMapParams& params = {});

  /// @param T_map_scanner  Where the scan was taken; not finite = passed over, as are beams whose
  ///                       angle is not.
  /// @throws std::runtime_error  if the map would then take more memory than is allowed.
  void add(const FloorPose& T_map_scanner, const LaserScan& scan);

  /// The map so far; unknown where no beam was.
  /// @throws std::invalid_argument  if no scan was added.
  OccupancyGrid grid() const;

 private:
  struct Count {
    std::uint32_t hits = 0;
    std::uint32_t misses = 0;
  };

  void makeRoom(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  void countBeam(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool ended);

  ScanMapParams params_;
  Eigen::Vector2i corner_ = Eigen::Vector2i::Zero();  // In cells from the origin.
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<Count> counts_;
};

}  // namespace heel
