// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Whether a person can be seen at a place: the paper's geometric filtering (section 3.2).
#pragma once

#include <heel/tracking/clutter_map.hpp>
#include <heel/tracking/observation.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace heel {

/// What a geometric gate says of an observation.
enum class GateVerdict {
  kAccepted,
  kNotFinite,    ///< Its place or a score is not a number; the tracker finds this itself.
  kTooClose,     ///< Closer to the camera than a person can be seen.
  kOutOfBounds,  ///< Outside the room.
  kBehindWall,   ///< A wall of the map crosses its ray.
  kInsideWall,   ///< At a place that the map says is wall.
};
inline constexpr std::size_t kGateVerdicts = 6;

/// A few words for people, e.g. "behind a wall".
const char* toText(GateVerdict verdict);

/// From where the observations were made, in their frame.
struct Viewpoint {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< The camera, on the floor.
  /// How sure that place is, for gates that widen their margins by it.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  SightOf sight_of = {};  ///< What is seen of a place; empty: nothing is known.
};

/// Says whether a person can be seen at the observation's place, or why not. Must be deterministic;
/// the tracker calls it once for each observation. An empty one accepts everything.
using GeometricGate = std::function<GateVerdict(const Observation&, const Viewpoint&)>;

/// Rejects what is closer to the camera than `distance_m`.
/// @throws std::invalid_argument  unless `distance_m` is finite and not negative.
GeometricGate tooClose(double distance_m);

/// Rejects what is outside the rectangle from `lowest_m` to `highest_m` (its edge is inside).
/// @throws std::invalid_argument  if a lowest coordinate is not under the highest.
GeometricGate insideBounds(const Eigen::Vector2d& lowest_m, const Eigen::Vector2d& highest_m);

/// Accepts what all `gates` accept; else gives the verdict of the first that rejects.
GeometricGate allOf(std::vector<GeometricGate> gates);

}  // namespace heel
