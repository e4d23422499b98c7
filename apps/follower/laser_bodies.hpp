// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a laser scan shows of a person's size, and where nobody is.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/planning/surroundings.hpp>
#include <heel/tracking/clutter_map.hpp>
#include <heel/tracking/observation.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// Which ends of beams are taken for people.
struct LaserBodiesParams {
  double off_map_m = 0.15;  ///< A beam's end this near to something on the map is that.
  /// Nothing further away is taken for legs: there a leg is a beam or two.
  double max_range_m = 5.0;
  /// Ends of neighbouring beams that are further apart are of two things.
  double max_gap_m = 0.3;
  double max_width_m = 0.9;  ///< A thing that is wider than this is no person,
  /// nor is one with an unbroken surface that is wider: legs are two, and a long skirt is 0.5 m.
  double max_surface_m = 0.55;
  double pair_m = 0.5;  ///< Two legs nearer to each other than this are one person's.
  /// Standard deviation of a person's place by their legs: these stride, and a thing's middle
  /// shifts as the robot drives around it.
  double sigma_m = 0.05;
  double half_width_m = 0.35;  ///< Legs are no further than this to the side of a person's place.
  double reach_m = 0.4;        ///< Legs are no further than this before or behind a person's place.
  double max_age_s = 0.3;      ///< A scan that is older than this says nothing.
};

/// Finds, in a scan, things of a person's size that the map does not show. Reuses its memory.
class LaserBodies {
 public:
  /// @throws std::invalid_argument  if a parameter is negative or not finite.
  explicit LaserBodies(const LaserBodiesParams& params = {});

  /// @param scan       Null if there is none in this step.
  /// @param clearance  Distance to what the map shows in the laser's plane [m, world].
  /// @param elapsed_s  Since the step before.
  void step(const LaserScan* scan, const FloorPose& T_world_scanner, const Clearance& clearance,
            double elapsed_s);

  /// Whether the last scan is young enough.
  bool isFresh() const { return age_s_ <= params_.max_age_s; }

  /// Persons and things, without looks; the score is the number of beams. In the world.
  const std::vector<Observation>& bodies() const { return bodies_; }

  /// What the scan says of a person at a place of the world: free where it goes through; a thing
  /// where it ends at what the map shows, or at what is too wide for a person; unknown where one
  /// may stand.
  Sight sightOf(const Eigen::Vector2d& place_m) const;

 private:
  void endRun(std::size_t first, std::size_t end);
  double widestSurface(std::size_t first, std::size_t end) const;

  LaserBodiesParams params_;
  LaserScan scan_;
  Eigen::Isometry2d T_scanner_world_;
  double age_s_;
  std::vector<Eigen::Vector2d> ends_m_;  // in the world
  std::vector<bool> may_be_person_;      // what a beam ends at
  std::vector<Observation> bodies_;
};

}  // namespace heel
