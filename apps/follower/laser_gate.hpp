// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Nobody stands where the laser sees nothing but the map.
#pragma once

#include "mapping/floor_pose.hpp"
#include "mapping/laser_scan.hpp"
#include "tracking/geometric_gate.hpp"

#include <functional>
#include <vector>

namespace heel {

struct LaserGateParams {
  double half_width_m = 0.35;   ///< Legs are no further than this to the sides of a place, ...
  double reach_m = 0.4;         ///< ... nor than this before or behind it, and a depth's error.
  double off_map_m = 0.1;       ///< An end nearer than this to what the map shows is that.
  double max_gap_m = 0.2;       ///< Ends of neighbouring beams further apart are two things.
  double max_width_m = 0.9;     ///< A wider thing is no person.
  double depth_error_pm = 0.0;  ///< A depth's standard deviation over its square [1/m].
  double sigmas = 2.0;          ///< So many standard deviations are allowed for.
  double max_age_s = 0.3;       ///< An older scan says nothing.
  int least_beams = 3;          ///< Nor do fewer beams than these.
};

/// Judges what the camera takes for a person by the laser: stereo sees plain walls too near, and
/// furniture of the target's colours may be as high as they are, but the map shows the one, and
/// the other is wider than a person. Where something stands before a place, or the laser does not
/// look, it says nothing. Observations are in the map's frame. Reuses its memory.
class LaserGate {
 public:
  using Clearance = std::function<double(const Eigen::Vector2d&)>;

  /// @param clearance  Distance to what the map shows in the laser's plane [m, world].
  /// @throws std::invalid_argument  if there is none, or a parameter is out of its range.
  explicit LaserGate(Clearance clearance, const LaserGateParams& params = {});

  /// @param scan  Null if there is none in this step.
  /// @param elapsed_s  Since the step before.
  void step(const LaserScan* scan, const FloorPose& T_world_scanner, double elapsed_s);

  GateVerdict judge(const Observation& seen) const;

 private:
  void measureThings();

  Clearance clearance_;
  LaserGateParams params_;
  LaserScan scan_;
  FloorPose T_world_scanner_;
  std::vector<Eigen::Vector2d> directions_;  // of the beams, in the scanner's frame
  std::vector<Eigen::Vector2d> ends_m_;
  std::vector<double> widths_m_;  // of the things that they end at; infinite if the map shows it
  double age_s_;
};

}  // namespace heel
