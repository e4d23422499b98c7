// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A floor drawn of exact shapes, people who walk on it, and a robot that drives there.
#pragma once

#include <heel/planning/local_planner.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <random>
#include <vector>

namespace heel::test {

/// Boxes along the axes, and discs.
struct DrawnFloor {
  struct Box {
    Eigen::Vector2d low, high;
  };
  struct Disc {
    Eigen::Vector2d center;
    double radius_m;
  };
  Eigen::Vector2d low{0.0, 0.0}, high{6.0, 6.0};  ///< A wall stands around this.
  std::vector<Box> boxes;
  std::vector<Disc> discs;

  /// Exact distance to the nearest thing [m]; not positive inside one.
  double clearance(const Eigen::Vector2d& p) const;
};

/// A room of 6 m x 4 m with a wall of 0.12 m across at x = 3, and a gap around y = 2 in it.
DrawnFloor roomWithDoorway(double width_m);

/// A room with a random mix of walls with gaps, boxes and discs.
DrawnFloor randomFloor(std::mt19937& random);

/// A point with at least this much room, drawn at random; the middle after many tries.
Eigen::Vector2d randomFreePoint(const DrawnFloor& floor, double room_m, std::mt19937& random);

/// The shortest way for a disc on a 5 cm grid, a little more expensive near things, smoothed; empty
/// if there is none.
std::vector<Eigen::Vector2d> wayOn(const DrawnFloor& floor, const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& to, double radius_m);

/// Walks to and fro on a line and stops for the robot only just before it would walk into it.
struct LineWalker {
  Eigen::Vector2d from, to;
  double speed_mps = 1.0;
  double stop_gap_m = 0.15;
  double patience_s = 3.0;  ///< Turns back after waiting this long.
  double waited_s = 0.0;
  MovingPerson person;

  void step(double dt_s, const Eigen::Vector2d& robot, double robot_radius_m);
};

/// A robot in closed loop, a command per period; its commands act `late_periods` later.
class DriveLoop {
 public:
  DriveLoop(const DrawnFloor& floor, const FloorPose& start, const LocalPlannerParams& params = {},
            int late_periods = 0);

  /// One control period along `path`.
  const LocalPlan& step(const std::vector<Eigen::Vector2d>& path,
                        const std::optional<Eigen::Vector2d>& face = std::nullopt);

  const DriveState& state() const { return state_; }
  const LocalPlan& plan() const { return plan_; }
  double time_s() const { return time_s_; }
  /// Mean speed while it moved at all [m/s].
  double movingSpeed() const { return moving_s_ > 0.0 ? way_m_ / moving_s_ : 0.0; }
  /// Least room to things and to people so far; negative = contact.
  double leastGap() const { return least_gap_m_; }
  double leastPeopleGap() const { return least_people_gap_m_; }
  int turnReversals() const { return turn_reversals_; }

  DrawnFloor floor;
  std::vector<LineWalker> walkers;

 private:
  LocalPlanner planner_;
  DriveState state_;
  LocalPlan plan_;
  std::vector<VelocityCommand> queue_;
  std::vector<MovingPerson> people_;
  double time_s_ = 0.0, way_m_ = 0.0, moving_s_ = 0.0;
  double least_gap_m_ = 1e9, least_people_gap_m_ = 1e9;
  double last_turn_ = 0.0;
  int turn_reversals_ = 0;
};

}  // namespace heel::test
