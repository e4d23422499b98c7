// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A path on the floor as a line of way points, and what of it is still ahead of a robot.
#pragma once

#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace heel {

using FloorPath = std::vector<Eigen::Vector2d>;

/// Length of the line through these points [m].
double pathLength(const FloorPath& path);

/// The same line with its way points and, evenly between each two of them, so many more that no
/// step is longer than `step_m`.
/// @throws std::invalid_argument  unless the step is positive.
void resample(const FloorPath& path, double step_m, FloorPath& out);
FloorPath resample(const FloorPath& path, double step_m);

/// The stretch of a path that lies ahead of the robot, sampled every few centimetres.
class PathAhead {
 public:
  /// Where a point is, seen from the path.
  struct Place {
    std::size_t index = 0;       ///< Of the nearest sample.
    double left_m = 0.0;         ///< From the nearest point of the path to the stretch's end.
    double off_m = 0.0;          ///< To that point.
    double direction_rad = 0.0;  ///< Of the path at the nearest sample.
  };

  /// Takes the stretch of at most `reach_m` that begins at the point of `path` nearest to
  /// `position` (of equally near ones the first).
  /// @param path  Corners [m, world]; finite, not empty.
  void take(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& position,
            double reach_m);
  void clear() { points_.clear(); }

  bool empty() const { return points_.empty(); }
  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// Whether the stretch goes on to the path's own end.
  bool endsAtGoal() const { return ends_at_goal_; }
  Place locate(const Eigen::Vector2d& point) const;
  /// Index of the nearest sample from `from` on, as far as the distance does not grow.
  std::size_t advance(const Eigen::Vector2d& point, std::size_t from) const;
  double direction(std::size_t index) const;

  static constexpr double kSpacing_m = 0.05;

 private:
  std::vector<Eigen::Vector2d> points_;
  bool ends_at_goal_ = false;
};

/// How to drive along a path: pure pursuit with a speed that falls when the way bends.
struct Pursuit {
  double speed_mps = 0.3;    ///< On a straight stretch.
  double look_m = 0.35;      ///< How far ahead the point is that it drives at.
  double aside_m = 0.0;      ///< Drives this much to the left of the path.
  double turn_gain = 2.2;    ///< Turn per angle to that point [1/s].
  bool turns_first = false;  ///< Stands until that point is straight ahead.
};

/// Adds the future in which the robot pursues the path; turns on the spot when the way lies aside.
void addPursuit(const DriveLimits& limits, const DriveState& now, const PathAhead& path,
                const Pursuit& pursuit, Trajectories& out);

}  // namespace heel
