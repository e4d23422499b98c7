// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where to stand to be with a person: near, in view, and in nobody's way.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/doorways.hpp>
#include <heel/planning/surroundings.hpp>

#include <optional>
#include <vector>

namespace heel {

/// How near to be, and what makes a place bad.
struct GoalChooserParams {
  double standoff_m = 1.0;        ///< Distance to keep, from the person's middle to the robot's.
  double least_standoff_m = 0.8;  ///< The robot never stands nearer to the person than this.
  /// The robot does not stand further from the person than this, if there is a place.
  double most_standoff_m = 1.6;
  double radius_m = 0.26;        ///< Radius of the robot.
  double margin_m = 0.08;        ///< Room that the robot needs around it.
  double lead_s = 0.4;           ///< The robot goes to where the person will be after this time.
  double doorway_depth_m = 0.7;  ///< Passage reaches this far before and behind a doorway.
  double keep_m = 0.25;          ///< A new place must be cheaper by what this much way costs.
  // Costs.
  double way_cost = 1.0;       ///< Cost per metre of straight line from the robot.
  double standoff_cost = 2.5;  ///< Cost per metre nearer or further than standoff_m.
  /// Cost of standing in the middle of a passage; less towards its rims.
  double doorway_cost = 2.0;
  double narrow_cost = 0.5;  ///< Cost of having no more room than needed; 0 with 0.3 m more.
  double ahead_cost = 0.6;   ///< Cost of standing where a person is walking to at 1 m/s.
  double unseen_cost = 3.0;  ///< Cost of a place from which the person is not seen.
};

/// A place to stand, turned to the person.
struct StandPlace {
  FloorPose pose;
  bool in_view = false;     ///< Whether the person is seen from there.
  bool in_doorway = false;  ///< Whether that is in a passage.
  double cost = 0.0;
};

/// Chooses among places on rings about the person; keeps the last choice unless another is clearly
/// better, so that the goal does not jitter.
class GoalChooser {
 public:
  /// @throws std::invalid_argument  if the distances are out of order.
  explicit GoalChooser(const GoalChooserParams& params = {});

  /// @param target     Who to be with; nothing if that isn't finite.
  /// @param clearance  Distance to what stands, without the target.
  /// @param sees       Line of sight on the map.
  /// @return  nothing if there is no place with room. Whether one can be reached is not asked: the
  ///          way counts as the straight line.
  std::optional<StandPlace> choose(const MovingPerson& target, const FloorPose& robot,
                                   Clearance clearance, LineOfSight sees,
                                   const std::vector<DoorwayOnMap>& doorways);

  /// Forgets the last choice.
  void reset() { last_.reset(); }

  const GoalChooserParams& params() const { return params_; }

 private:
  GoalChooserParams params_;
  std::optional<Eigen::Vector2d> last_;
};

/// How far inside a doorway's passage a point is: 1 in its middle line and plane, 0 outside.
double inPassage(const DoorwayOnMap& doorway, const Eigen::Vector2d& point, double depth_m,
                 double radius_m);

}  // namespace heel
