// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where to stand to be with a person: near, in view, and in nobody's way.
#pragma once

#include <heel/planning/doorways.hpp>
#include <heel/planning/surroundings.hpp>

#include <optional>
#include <vector>

namespace heel {

/// How near to be, and what makes a place bad.
struct GoalChooserParams {
  double standoff_m = 1.0;      ///< Distance to keep, from the person's middle to the robot's.
  double nearest_share = 0.8;   ///< The robot never stands nearer than this share of standoff_m.
  double furthest_share = 1.6;  ///< Nor further than so many times standoff_m, if there is a place.
  double radius_m = 0.26;       ///< Radius of the robot.
  double margin_m = 0.08;       ///< Room that the robot needs around it.
  double lead_s = 0.4;          ///< The robot goes to where the person will be after this time.
  double doorway_depth_m = 0.7;  ///< Passage reaches this far before and behind a doorway.
  double half_view_rad = 0.4;    ///< Whoever is further to a side of the way is not seen on it.
};

/// Chooses among places on rings about the person; keeps the last choice unless another is clearly
/// better, so that the goal does not jitter.
class GoalChooser {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit GoalChooser(const GoalChooserParams& params = {});

  /// @param target     Who to be with; nothing if that isn't finite.
  /// @param clearance  Distance to what stands, without the target.
  /// @param sees       Line of sight on the map.
  /// @return  a place [m, world], or nothing if none has room. Whether one can be reached is not
  /// asked: the
  ///          way counts as the straight line.
  std::optional<Eigen::Vector2d> choose(const MovingPerson& target, const Eigen::Vector2d& robot,
                                        Clearance clearance, LineOfSight sees,
                                        const std::vector<DoorwayOnMap>& doorways);

  /// Forgets the last choice.
  void reset() { last_.reset(); }

 private:
  GoalChooserParams params_;
  std::optional<Eigen::Vector2d> last_;
};

}  // namespace heel
