// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who moves around the robot, as its laser sees them: for these are not on any map.
#pragma once

#include "mapping/floor_pose.hpp"
#include "mapping/laser_scan.hpp"
#include "planning/surroundings.hpp"
#include "tracking/tracker.hpp"

#include <vector>

namespace heel {

struct PeopleAroundParams {
  double off_map_m = 0.2;    ///< An end this near to what the map shows is that.
  double max_range_m = 5.0;  ///< Further away, a leg is a beam or two.
  double max_gap_m = 0.3;    ///< Ends of neighbouring beams further apart are two things.
  double max_size_m = 0.9;   ///< A wider thing is no person.
  double pair_m = 0.5;       ///< Two legs nearer than this are one person's.
  double walked_m = 0.5;     ///< Who is so far from where they were first, walks.
  double person_radius_m = 0.25;
  double max_speed_mps = 2.0;  ///< Nobody indoors is faster; what seems so is two things.
  TrackerParams tracker = defaultTracker();

  static TrackerParams defaultTracker();
};

/// Tracks everything of a person's size that the map does not show. Who has walked is a person from
/// then on; what has never moved is furniture, and left to who looks for obstacles.
class PeopleAround {
 public:
  explicit PeopleAround(const PeopleAroundParams& params = {});

  /// @param clearance  Distance to what the map shows [m, world].
  void step(double stamp_s, const LaserScan& scan, const FloorPose& T_world_scanner,
            const Clearance& clearance);

  /// Where they are now, with their speeds, in the world.
  const std::vector<MovingPerson>& people() const { return people_; }

 private:
  void findThings(const LaserScan& scan, const FloorPose& T_world_scanner,
                  const Clearance& clearance);
  void addThing(const std::vector<Eigen::Vector2d>& ends);
  bool hasWalked(const Track& track);

  PeopleAroundParams params_;
  Tracker tracker_;
  std::vector<Eigen::Vector2d> ends_;  // of the thing that is being gathered
  std::vector<Observation> things_;
  /// Of a track: where it was first, and whether it has left that place.
  struct Walk {
    int track_id;
    Eigen::Vector2d from_m;
    bool has_walked;
  };
  std::vector<Walk> walks_;
  std::vector<MovingPerson> people_;
};

}  // namespace heel
