// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the robot must not touch: things that stand, and people who move.
#pragma once

#include <heel/planning/function_ref.hpp>

#include <Eigen/Core>

namespace heel {

/// Distance from a point of the floor to the nearest thing that stands there [m, world]; NaN where
/// nobody knows, infinite where there is nothing.
using Clearance = FunctionRef<double(const Eigen::Vector2d&)>;

/// Whether a point of the floor can be seen from another [world].
using LineOfSight = FunctionRef<bool(const Eigen::Vector2d& from, const Eigen::Vector2d& to)>;

/// In a house nobody walks faster than this [m/s].
inline constexpr double kFastestWalk_mps = 1.6;
/// Who is slower than this stands: their track drifts no faster [m/s].
inline constexpr double kSlowestWalk_mps = 0.15;
/// Who walks gains speed no faster than this: from standing to a stroll within a step [m/s^2].
inline constexpr double kWalkersGain_mps2 = 2.0;
/// Who came or stood somewhere is taken to stay there for so long, if nothing else is seen [s].
inline constexpr double kStays_s = 30.0;

/// Somebody who may walk, as a disc on the floor.
struct MovingPerson {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m, world]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [m/s]
  double radius_m = 0.25;
  double gait_mps = 0.0;  ///< The velocity may be so far off, any way.
  double rests_s = 0.0;   ///< Has stood there for so long, and is taken to stay; 0: may walk.
};

}  // namespace heel
