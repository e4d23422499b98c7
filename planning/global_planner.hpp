// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The way to a place on the whole map.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/clearance_map.hpp>
#include <heel/planning/grid_wave.hpp>
#include <heel/planning/path.hpp>
#include <heel/planning/taut_path.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// How paths are planned.
struct GlobalPlannerParams {
  double robot_radius_m = 0.3;  ///< Radius of the robot.
  double safety_m = 0.01;       ///< Room that paths keep beyond the robot's radius.
  /// Room beyond radius and safety_m from which on more is worth no detour.
  double comfort_m = 0.2;
  double bend_room_m = 0.0;  ///< Bends are so much wider than they must be, where there is room.
  /// A path to a goal that can't be reached ends no further from it than this.
  double goal_tolerance_m = 0.5;
  double escape_m = 0.6;         ///< How far to look for room when the robot is too near something.
  bool unknown_is_free = false;  ///< Whether paths go where the map knows nothing.
};

/// What came of planning.
enum class PlanStatus {
  kFound,           ///< The path ends at the goal.
  kFoundNearby,     ///< The goal can't be reached; the path ends at the nearest place that can.
  kStartOutside,    ///< The start is not on the map.
  kStartBlocked,    ///< The start is inside something, or shut in by it.
  kGoalOutside,     ///< The goal is not on the map.
  kGoalUnreachable  ///< No way to the goal, nor to any place within the tolerance.
};

/// A short name, for instance "goal_unreachable".
const char* nameOf(PlanStatus status);

/// A path, or why there is none.
struct GlobalPlan {
  PlanStatus status = PlanStatus::kGoalUnreachable;
  FloorPath path;         ///< From the start to `end`; empty unless found.
  double length_m = 0.0;  ///< Of the path.
  /// The goal, or the place nearest to it that can be reached; the start where nothing was found.
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  /// Length of the first piece if the start is nearer to something than the radius and safety: it
  /// leads to a place with room, never nearer to anything than the start is. Else 0.
  double escape_m = 0.0;
  bool searched_anew = false;  ///< False where the kept search was enough.

  bool found() const { return status == PlanStatus::kFound || status == PlanStatus::kFoundNearby; }
};

/// Plans any-angle paths for a round robot. A search spreads from the robot over the free cells and
/// is kept: when the goal moves, it goes on where it stopped; when the robot has moved a little, or
/// obstacles have come or gone, what still holds of it is used. Its path is then pulled taut, which
/// undoes the grid's few directions. Every piece of the path is exactly clear.
///
/// There are two such searches: a quick one on cells three times as wide, all of whose moves are
/// looked at when the map is taken; and where that finds no way (through a very narrow passage,
/// away from a wall that the robot is too near to, or to a place beside a goal that can't be
/// reached), a thorough one on the map's cells.
///
/// A passage that is narrower than the robot with its safety by less than a cell more may be
/// missed: the search stands on cells' middles. Where there is another way, so may one that is
/// wider by less than two cells and winds. No allocation once warm.
class GlobalPlanner {
 public:
  /// @throws std::invalid_argument  if the map is empty or a parameter is out of its range.
  GlobalPlanner(const OccupancyGrid& map, const GlobalPlannerParams& params);
  GlobalPlanner(const GlobalPlanner&) = delete;
  GlobalPlanner& operator=(const GlobalPlanner&) = delete;

  /// Takes these, in place of those before, as blocked besides the map: discs, and the occupied
  /// cells of a grid, which may be smaller and of another cell size.
  /// @throws std::invalid_argument  if a disc is not finite.
  void setObstacles(const std::vector<FloorDisc>& discs, const OccupancyGrid* cells = nullptr);

  /// @param start,goal  World [m].
  /// @throws std::invalid_argument  if a coordinate is not finite.
  void plan(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, GlobalPlan& plan);
  GlobalPlan plan(const Eigen::Vector2d& start, const Eigen::Vector2d& goal);

  /// Forgets the kept search; the next plan is made anew.
  void forget() { quick_.has_root = thorough_.has_root = false; }

  const ClearanceMap& clearance() const { return map_; }
  const GlobalPlannerParams& params() const { return params_; }

 private:
  bool isClear(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    return map_.isClear(a, b, radius_m_);
  }
  /// A search that is kept.
  struct Search {
    GridWave wave;
    bool is_quick;
    bool has_root = false;
    bool mended = false;                             ///< Since it began.
    Eigen::Vector2d root = Eigen::Vector2d::Zero();  ///< Where it began.
  };
  Search makeSearch(int stride, bool is_quick) const;
  void mend(Search& search, const std::vector<int>& changed);
  void planBy(Search& search, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
              GlobalPlan& plan);
  bool beginAt(Search& search, const Eigen::Vector2d& start);
  bool canKeepRoot(const Search& search, const Eigen::Vector2d& start) const;
  bool findPath(Search& search, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                GlobalPlan& plan);
  bool trace(const Search& search, int cell, const Eigen::Vector2d& start,
             const Eigen::Vector2d& goal, GlobalPlan& plan);
  void finish(PlanStatus status, GlobalPlan& plan);

  GlobalPlannerParams params_;
  double radius_m_;
  ClearanceMap map_;
  Search quick_, thorough_;
  TautPath taut_;
  std::vector<WaveSeed> seeds_;
  std::vector<int> near_goal_, near_start_;
};

}  // namespace heel
