// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What makes one future of the robot better than another: small costs, each on its own.
#pragma once

#include <heel/planning/path.hpp>
#include <heel/planning/surroundings.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace heel {

/// The costs, in the order of `DriveScores`.
enum class DriveTerm : std::size_t {
  kProgress,   ///< Share of the possible way along the path that it does not make, 0 to 2.
  kPath,       ///< Mean distance to the path, 0 to 1; half at 0.3 m.
  kHeading,    ///< Angle to the path's direction at the end, 0 to 1.
  kClearance,  ///< How much things that stand come within `comfort_m`, mean of squares.
  kPeople,     ///< How much people come within `people_comfort_m`; sooner counts more.
  kView,       ///< How far the point to face is outside the camera's view, in radians.
  kSmooth,     ///< Change of the command against the last one, 0 to about 2.
};
constexpr std::size_t kDriveTerms = 7;
using DriveScores = std::array<double, kDriveTerms>;
const char* nameOf(DriveTerm term);

/// What a motion costs.
struct DriveTermParams {
  /// Weights of the costs, in the order of DriveTerm: progress, path, heading, clearance, people,
  /// view, smoothness.
  DriveScores weights = {10.0, 2.0, 1.5, 2.0, 16.0, 1.5, 0.4};
  double comfort_m = 0.25;         ///< More room than this to walls and furniture is no better.
  double people_comfort_m = 0.35;  ///< More room than this to people is no better.
  double foresight_s = 2.0;        ///< How long people are taken to keep their velocity.
  /// The person is in view if no further than this from the middle of the picture.
  double half_view_rad = 0.4;
};

/// What all futures of one decision have in common.
struct DriveScene {
  DriveState now;
  VelocityCommand last;  ///< The command before this one.
  const PathAhead* path = nullptr;
  PathAhead::Place start;  ///< Of the robot on the path, if there is one.
  const std::vector<MovingPerson>* people = nullptr;
  double people_room_m = 0.0;  ///< A hair less than to the nearest of them now.
  std::optional<Eigen::Vector2d> face;
};

/// One future: poses a control period apart, and the room around the robot's body at each.
struct DriveOption {
  const FloorPose* poses = nullptr;
  const double* gaps_m = nullptr;
  std::size_t steps = 0;
  std::size_t clear_steps = 0;  ///< Before the first contact; `steps` if there is none.
  VelocityCommand command;
};

/// The room between the robot's body and the nearest person, `after_s` from now; infinite if
/// nobody is there.
double roomToPeople(const std::vector<MovingPerson>& people, const DriveLimits& limits,
                    const FloorPose& pose, double after_s);

/// The room to one who may be anywhere on their way up to then.
double roomToWay(const MovingPerson& person, const DriveLimits& limits, const FloorPose& pose,
                 double after_s);

/// The least such room.
double roomToWays(const std::vector<MovingPerson>& people, const DriveLimits& limits,
                  const FloorPose& pose, double after_s);

/// The costs of a future, without weights.
DriveScores driveCosts(const DriveLimits& limits, const DriveTermParams& params,
                       const DriveScene& scene, const DriveOption& option);

/// Their weighted sum.
double total(const DriveScores& costs, const DriveScores& weights);

}  // namespace heel
