// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The beams of a scan that localization looks at, and how well the map explains them.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/mapping/likelihood_field.hpp>

#include <vector>

namespace heel {

/// Which beams are used.
struct ScanBeamsParams {
  /// At most so many beams are used, spread evenly over those that may be.
  std::size_t beams = 60;
  /// Beams that end further away than this tell too little for their errors.
  double max_range_m = 20.0;
};

/// Chooses the ends of beams that are finite, in range, and on none of the discs.
class ScanBeams {
 public:
  /// @throws std::invalid_argument  unless there are beams, and `max_range_m` is above 0.05.
  ScanBeams(const FloorPose& T_base_scanner, const ScanBeamsParams& params);

  /// @param leave_out  What ends in these is left out: people who are tracked, in the base frame.
  /// @param T_base_then  Where the base was when the scan was measured, in the base frame.
  const BeamEnds& choose(const LaserScan& scan, const std::vector<FloorDisc>& leave_out,
                         const FloorPose& T_base_then = {});

  const BeamEnds& ends() const { return ends_; }
  const FloorPose& T_base_scanner() const { return T_base_scanner_; }

 private:
  FloorPose T_base_scanner_;
  ScanBeamsParams params_;
  std::vector<Eigen::Vector2d> usable_;
  BeamEnds ends_;
};

/// What the map says about a scan taken at a pose, as shares of its beams; they add up to 1.
struct ScanResiduals {
  double explained = 0.0;  ///< Ended near a mapped surface, or as far off as the map expects.
  double shorter = 0.0;    ///< Ended before it: something that is not in the map.
  double beyond = 0.0;     ///< Went through what the map says is solid: no person can cause this.
  int beams = 0;

  /// What is in the way of a beam says little against the pose, so it counts for so much of what a
  /// beam that went through a wall does.
  static constexpr double kShorterCounts = 0.25;

  /// How well the scan fits, in [0, 1]; 1 without beams.
  double fit() const;
};

/// @param near_m  How far an end may be from where the map has it.
/// @param not_shorter  Also, if not null: the ends of all beams but the shorter ones.
ScanResiduals scanResiduals(const LikelihoodField& field, const BeamEnds& ends,
                            const FloorPose& pose, const FloorPose& T_base_scanner, double near_m,
                            BeamEnds* not_shorter = nullptr);

}  // namespace heel
