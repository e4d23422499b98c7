// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where to stand so that somebody can get past the robot.
#pragma once

#include <heel/planning/doorways.hpp>
#include <heel/planning/surroundings.hpp>

#include <vector>

namespace heel {

/// How much room a person needs to pass, and where the robot waits.
struct WaysideParams {
  double radius_m = 0.26;        ///< Radius of the robot.
  double margin_m = 0.08;        ///< Room that the robot needs around it.
  double person_m = 0.3;         ///< Half the width that a person needs to walk by.
  double reach_m = 3.0;          ///< Places further from the robot than this are not looked at.
  double doorway_depth_m = 0.9;  ///< People come through this far before and behind a doorway.
  double apart_m = 0.4;          ///< Places nearer to each other than this are one.
};

/// Whether a person can walk by a robot that stands at `place`, on its left or on its right.
/// @param clearance  Distance to what stands, without robot and person [m].
bool leavesRoom(const Eigen::Vector2d& place, const Eigen::Vector2d& person, Clearance clearance,
                const WaysideParams& params = {});

/// Places near the robot where it would leave room to people, the nearest first: outside of
/// doorways, and not towards any of them. A robot that is in a doorway goes out of it even to where
/// it leaves them no room to walk by: these places come last. Whether there is a way to a place is
/// for a planner to say.
/// @param people     Those near the robot [m, world].
/// @param clearance  As for leavesRoom().
/// @param out  The places [m, world]; its memory is used again.
void findWaysides(const Eigen::Vector2d& robot, const std::vector<Eigen::Vector2d>& people,
                  Clearance clearance, const std::vector<DoorwayOnMap>& doorways,
                  const WaysideParams& params, std::vector<Eigen::Vector2d>& out);

}  // namespace heel
