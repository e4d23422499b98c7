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
  /// Who leaves a place by so much, within rests_after_s, walks; the middle of what is seen of a
  /// thing that stands shifts as much, slowly, when the robot drives around it.
  double stride_m = 0.3;
  double rests_after_s = 2.0;  ///< Who has not done so for as long stands, ...
  double stays_s = 30.0;  ///< ... and is a person, with more around them than legs, for so long.
  double thing_after_s = 8.0;   ///< What has stood for so long since it was first seen is a thing.
  double thing_within_m = 0.3;  ///< What is this near to where a thing always stood is that thing.
  double person_radius_m = 0.25;
  double max_speed_mps = 2.0;  ///< Nobody indoors is faster; what seems so is two things.
  TrackerParams tracker = defaultTracker();

  static TrackerParams defaultTracker();
};

/// Tracks everything of a person's size that the map does not show, and tells of what walks or has
/// walked. What never did, furniture or person, is left to who looks for obstacles.
class PeopleAround {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit PeopleAround(const PeopleAroundParams& params = {});

  /// @param clearance  Distance to what the map shows [m, world].
  void step(double stamp_s, const LaserScan& scan, const FloorPose& T_world_scanner,
            const Clearance& clearance);

  /// The camera sees somebody there: whatever the laser has seen there so far is no thing.
  void confirm(const Eigen::Vector2d& place_m, double within_m);

  /// Whoever or whatever is nearest to a place, walking or not; 0 if nobody is within reach.
  int nearest(const Eigen::Vector2d& place_m, double within_m) const;
  /// Whether another thing of a person's size is this near to one.
  bool hasOtherNear(int id, double within_m) const;
  /// All that are of a person's size.
  const std::vector<Track>& tracks() const { return tracker_.tracks(); }
  /// Their track, or null if it has ended.
  const Track* find(int id) const { return tracker_.findTrack(id); }

  /// Where they are now, with their speeds, in the world.
  const std::vector<MovingPerson>& people() const { return people_; }
  /// Tracks of those of them who were seen to walk: surely no furniture.
  const std::vector<int>& walkers() const { return walkers_; }

 private:
  void findThings(const LaserScan& scan, const FloorPose& T_world_scanner,
                  const Clearance& clearance);
  void addThing(const std::vector<Eigen::Vector2d>& ends);
  /// Time since the last stride; infinite if there was none.
  double restsFor_s(const Track& track, double stamp_s);
  bool hasWalked(const Track& track) const;
  /// Whether something stands there that never walked. Of somebody who passes it closely the laser
  /// may take one for the other, and a carton would be a person from then on.
  bool isThing(const Eigen::Vector2d& place_m) const;

  PeopleAroundParams params_;
  Tracker tracker_;
  std::vector<Eigen::Vector2d> ends_;  // of the thing that is being gathered
  std::vector<Observation> things_;
  std::vector<Eigen::Vector2d> standing_m_;  // what never walked
  /// The last stride of a track, and since when a new one is measured from where.
  struct Stride {
    int track_id;
    double born_s;
    Eigen::Vector2d place_m;
    double since_s;
    double stamp_s;
    bool walked = false;
  };
  std::vector<Stride> strides_;
  std::vector<MovingPerson> people_;
  std::vector<int> walkers_;
};

}  // namespace heel
