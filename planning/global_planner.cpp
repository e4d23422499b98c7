// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "planning/global_planner.hpp"

#include "planning/free_cells.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

/// The free cells that a point joins the grid by are within so many cells.
constexpr double kJoinCells = 2.5;
/// A kept search is good enough if its path is at most this much longer than it could be.
constexpr double kKeptMayBeLonger = 1.02;

GlobalPlannerParams checked(const GlobalPlannerParams& p) {
  const double sum = p.robot_radius_m + p.safety_m + p.comfort_m + p.crowding + p.bend_room_m +
                     p.goal_tolerance_m + p.escape_m + p.keep_root_m;
  if (!std::isfinite(sum)) throw std::invalid_argument("a planner's parameters must be finite");
  if (!(p.robot_radius_m > 0.0 && p.comfort_m > 0.0)) {
    throw std::invalid_argument("a planner's robot radius and comfort must be positive");
  }
  if (std::min({p.safety_m, p.crowding, p.bend_room_m, p.goal_tolerance_m, p.escape_m,
                p.keep_root_m}) < 0.0) {
    throw std::invalid_argument("a planner's lengths and shares must not be negative");
  }
  return p;
}

/// How far clearances matter: to the end of comfort, and for two cells of a move.
double reachFor(const OccupancyGrid& map, const GlobalPlannerParams& p) {
  return p.robot_radius_m + p.safety_m + std::max(p.comfort_m, p.bend_room_m) +
         2.0 * map.cell_size_m();
}

}  // namespace

const char* nameOf(PlanStatus status) {
  switch (status) {
    case PlanStatus::kFound:
      return "found";
    case PlanStatus::kFoundNearby:
      return "found_nearby";
    case PlanStatus::kStartOutside:
      return "start_outside";
    case PlanStatus::kStartBlocked:
      return "start_blocked";
    case PlanStatus::kGoalOutside:
      return "goal_outside";
    case PlanStatus::kGoalUnreachable:
      return "goal_unreachable";
  }
  return "";
}

GlobalPlanner::GlobalPlanner(const OccupancyGrid& map, const GlobalPlannerParams& params)
    : params_(checked(params)),
      radius_m_(params.robot_radius_m + params.safety_m),
      map_(map, reachFor(map, params_), params.unknown_is_free),
      wave_(map_, {radius_m_, params.comfort_m, params.crowding}),
      taut_(map_, radius_m_) {}

void GlobalPlanner::setObstacles(const std::vector<FloorDisc>& discs, const OccupancyGrid* cells) {
  const std::vector<int>& changed = map_.setLayer(discs, cells);
  if (changed.empty()) return;
  mended_ = true;
  // A root that something has come near to is of no use; its ways out may be cut.
  has_root_ = wave_.mend(changed) && has_root_ && isClear(root_, root_);
}

GlobalPlan GlobalPlanner::plan(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  GlobalPlan result;
  plan(start, goal, result);
  return result;
}

void GlobalPlanner::plan(const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                         GlobalPlan& plan) {
  if (!start.allFinite() || !goal.allFinite()) {
    throw std::invalid_argument("a plan's start and goal must be finite");
  }
  plan.path.clear();
  plan.length_m = plan.escape_m = 0.0;
  plan.end = start;
  plan.searched_anew = false;
  if (!map_.isInside(start)) return finish(PlanStatus::kStartOutside, plan);
  if (!map_.isInside(goal)) return finish(PlanStatus::kGoalOutside, plan);
  if (isClear(start, goal)) {
    plan.path = {start, goal};
    return finish(PlanStatus::kFound, plan);
  }
  if (canKeepRoot(start) && findPath(start, goal, plan)) return;
  if (!beginAt(start)) return finish(PlanStatus::kStartBlocked, plan);
  plan.searched_anew = true;
  findPath(start, goal, plan);
}

bool GlobalPlanner::canKeepRoot(const Eigen::Vector2d& start) const {
  if (!has_root_) return false;
  return start == root_ || ((start - root_).norm() <= params_.keep_root_m && isClear(root_, start));
}

/// Joins the start to the grid: to the free cells around it that it sees, or, where it is too near
/// to something, to the nearest that it can go to without coming nearer to anything.
bool GlobalPlanner::beginAt(const Eigen::Vector2d& start) {
  has_root_ = false;
  seeds_.clear();
  const double cell = map_.cell_size_m();
  freeCellsNear(map_, wave_, start, kJoinCells * cell, near_start_);
  for (const int near : near_start_) {
    const Eigen::Vector2d middle = wave_.placeOf(near);
    if (!isClear(start, middle)) continue;
    seeds_.push_back({near, static_cast<float>((middle - start).norm() / cell)});
  }
  if (seeds_.empty()) {
    constexpr double kHair_m = 1e-6;
    const double room = std::min(radius_m_, map_.clearance(start)) - kHair_m;
    if (room <= 0.0) return false;
    freeCellsNear(map_, wave_, start, params_.escape_m, near_start_);
    const auto way_out = std::find_if(near_start_.begin(), near_start_.end(), [&](int near) {
      return map_.isClear(start, wave_.placeOf(near), room);
    });
    if (way_out == near_start_.end()) return false;
    const double length = (wave_.placeOf(*way_out) - start).norm();
    seeds_.push_back({*way_out, static_cast<float>(length / cell)});
  }
  wave_.begin(seeds_);
  root_ = start;
  has_root_ = true;
  mended_ = false;
  return true;
}

/// @return  false if the kept search can't tell and it must begin anew.
bool GlobalPlanner::findPath(const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                             GlobalPlan& plan) {
  if (isClear(goal, goal)) {
    freeCellsNear(map_, wave_, goal, kJoinCells * map_.cell_size_m(), near_goal_);
    for (const int near : near_goal_) {
      if (!isClear(wave_.placeOf(near), goal) || !wave_.reach(near)) continue;
      plan.end = goal;
      return trace(near, start, goal, plan);
    }
  }
  freeCellsNear(map_, wave_, goal, params_.goal_tolerance_m, near_goal_);
  for (const int near : near_goal_) {
    if (!wave_.reach(near)) continue;
    plan.end = wave_.placeOf(near);
    return trace(near, start, goal, plan);
  }
  finish(PlanStatus::kGoalUnreachable, plan);
  return true;
}

/// Follows the search back from `cell` and pulls the way taut.
/// @return  false if it is the kept search's, and that is not good enough.
bool GlobalPlanner::trace(int cell, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                          GlobalPlan& plan) {
  FloorPath& path = plan.path;
  path.clear();
  if (plan.end != wave_.placeOf(cell)) path.push_back(plan.end);
  for (int at = cell; at >= 0; at = wave_.parent(at)) path.push_back(wave_.placeOf(at));
  const bool escapes = !isClear(root_, path.back());
  if (escapes && start != root_) return false;
  if (!escapes) {
    path.push_back(root_);
    if (start != root_) path.push_back(start);
  }
  std::reverse(path.begin(), path.end());
  if (mended_) {
    // Mending looks at cells; here is made sure that nothing new stands between two of them.
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (!isClear(path[i - 1], path[i])) return false;
    }
  }
  taut_.pull(path);
  if (!plan.searched_anew && start != root_) {
    const double from_root_m =
        wave_.cost(cell) * map_.cell_size_m() + (plan.end - wave_.placeOf(cell)).norm();
    const double least_m = from_root_m - (start - root_).norm();
    if (pathLength(path) > kKeptMayBeLonger * least_m) return false;
  }
  if (params_.bend_room_m > 0.0) taut_.widen(path, params_.bend_room_m);
  if (escapes) {
    plan.escape_m = (path.front() - start).norm();
    path.insert(path.begin(), start);
  }
  finish(plan.end == goal ? PlanStatus::kFound : PlanStatus::kFoundNearby, plan);
  return true;
}

void GlobalPlanner::finish(PlanStatus status, GlobalPlan& plan) {
  plan.status = status;
  if (!plan.found()) plan.path.clear();
  plan.length_m = pathLength(plan.path);
  if (plan.found()) plan.end = plan.path.back();
}

}  // namespace heel
