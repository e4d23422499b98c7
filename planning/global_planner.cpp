// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/global_planner.hpp>
#include <heel/planning/grid_wave.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

/// A way with less room than comfort_m counts as longer, by up to this share.
constexpr double kCrowding = 0.02;
/// How far the robot may move before a search begins anew.
constexpr double kKeepRoot_m = 0.6;

/// The free cells that a point joins the grid by are within so many cells.
constexpr double kJoinCells = 1.6;
/// A kept search is good enough if its path is at most this much longer than it could be.
constexpr double kKeptMayBeLonger = 1.02;
/// How many of the map's cells one of the quick search's is wide.
constexpr int kQuickStride = 3;

GlobalPlannerParams checked(const GlobalPlannerParams& p) {
  const double sum =
      p.robot_radius_m + p.safety_m + p.comfort_m + p.bend_room_m + p.goal_tolerance_m + p.escape_m;
  if (!std::isfinite(sum)) throw std::invalid_argument("a planner's parameters must be finite");
  if (!(p.robot_radius_m > 0.0 && p.comfort_m > 0.0)) {
    throw std::invalid_argument("a planner's robot radius and comfort must be positive");
  }
  if (std::min({p.safety_m, p.bend_room_m, p.goal_tolerance_m, p.escape_m}) < 0.0) {
    throw std::invalid_argument("a planner's lengths must not be negative");
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
      quick_(makeSearch(kQuickStride, true)),
      thorough_(makeSearch(1, false)),
      taut_(map_, radius_m_) {
  quick_.wave.learnMoves();
}

GlobalPlanner::Search GlobalPlanner::makeSearch(int stride, bool is_quick) const {
  return {GridWave(map_, {stride, radius_m_, params_.comfort_m, kCrowding}), is_quick};
}

void GlobalPlanner::setObstacles(const std::vector<FloorDisc>& discs, const OccupancyGrid* cells) {
  const std::vector<int>& changed = map_.setLayer(discs, cells);
  if (changed.empty()) return;
  mend(quick_, changed);
  mend(thorough_, changed);
}

void GlobalPlanner::mend(Search& search, const std::vector<int>& changed) {
  search.mended = true;
  // A root that something has come near to is of no use; its ways out may be cut.
  search.has_root =
      search.wave.mend(changed) && search.has_root && isClear(search.root, search.root);
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
  planBy(quick_, start, goal, plan);
  if (plan.status != PlanStatus::kFound) planBy(thorough_, start, goal, plan);
}

void GlobalPlanner::planBy(Search& search, const Eigen::Vector2d& start,
                           const Eigen::Vector2d& goal, GlobalPlan& plan) {
  plan.searched_anew = false;
  if (canKeepRoot(search, start) && findPath(search, start, goal, plan)) return;
  if (!beginAt(search, start)) return finish(PlanStatus::kStartBlocked, plan);
  plan.searched_anew = true;
  findPath(search, start, goal, plan);
}

bool GlobalPlanner::canKeepRoot(const Search& search, const Eigen::Vector2d& start) const {
  if (!search.has_root) return false;
  return start == search.root ||
         ((start - search.root).norm() <= kKeepRoot_m && isClear(search.root, start));
}

/// Joins the start to the grid: to the free cells around it that it sees, or, where it is too near
/// to something, to the nearest that it can go to without coming nearer to anything.
bool GlobalPlanner::beginAt(Search& search, const Eigen::Vector2d& start) {
  GridWave& wave = search.wave;
  search.has_root = false;
  seeds_.clear();
  const double cell = map_.cell_size_m();
  freeCellsNear(map_, wave, start, kJoinCells * wave.cell_size_m(), near_start_);
  for (const int near : near_start_) {
    const Eigen::Vector2d middle = wave.placeOf(near);
    if (!isClear(start, middle)) continue;
    seeds_.push_back({near, static_cast<float>((middle - start).norm() / cell)});
  }
  if (seeds_.empty()) {
    constexpr double kHair_m = 1e-6;
    const double room = std::min(radius_m_, map_.clearance(start)) - kHair_m;
    if (room <= 0.0 || search.is_quick) return false;
    freeCellsNear(map_, wave, start, params_.escape_m, near_start_);
    const auto way_out = std::find_if(near_start_.begin(), near_start_.end(), [&](int near) {
      return map_.isClear(start, wave.placeOf(near), room);
    });
    if (way_out == near_start_.end()) return false;
    const double length = (wave.placeOf(*way_out) - start).norm();
    seeds_.push_back({*way_out, static_cast<float>(length / cell)});
  }
  wave.begin(seeds_);
  search.root = start;
  search.has_root = true;
  search.mended = false;
  return true;
}

/// @return  false if the kept search can't tell and it must begin anew.
bool GlobalPlanner::findPath(Search& search, const Eigen::Vector2d& start,
                             const Eigen::Vector2d& goal, GlobalPlan& plan) {
  GridWave& wave = search.wave;
  wave.headFor(goal);
  if (isClear(goal, goal)) {
    freeCellsNear(map_, wave, goal, kJoinCells * wave.cell_size_m(), near_goal_);
    int best = -1;
    double least = 0.0;
    for (const int near : near_goal_) {
      const Eigen::Vector2d place = wave.placeOf(near);
      if (!isClear(place, goal)) continue;
      // With the first, all are reached that are on as short a way.
      if (best < 0 && !wave.reach(near)) continue;
      const double cost = wave.cost(near) * map_.cell_size_m() + (goal - place).norm();
      if (best >= 0 && cost >= least) continue;
      best = near;
      least = cost;
    }
    if (best >= 0) {
      plan.end = goal;
      return trace(search, best, start, goal, plan);
    }
  }
  finish(PlanStatus::kGoalUnreachable, plan);
  if (search.is_quick) return true;
  freeCellsNear(map_, wave, goal, params_.goal_tolerance_m, near_goal_);
  for (const int near : near_goal_) {
    if (!wave.reach(near)) continue;
    plan.end = wave.placeOf(near);
    return trace(search, near, start, goal, plan);
  }
  return true;
}

/// Follows the search back from `cell` and pulls the way taut.
/// @return  false if it is the kept search's, and that is not good enough.
bool GlobalPlanner::trace(const Search& search, int cell, const Eigen::Vector2d& start,
                          const Eigen::Vector2d& goal, GlobalPlan& plan) {
  const GridWave& wave = search.wave;
  const Eigen::Vector2d& root = search.root;
  FloorPath& path = plan.path;
  path.clear();
  if (plan.end != wave.placeOf(cell)) path.push_back(plan.end);
  for (int at = cell; at >= 0; at = wave.parent(at)) path.push_back(wave.placeOf(at));
  const bool escapes = !isClear(root, path.back());
  if (escapes && start != root) return false;
  if (!escapes) {
    path.push_back(root);
    if (start != root) path.push_back(start);
  }
  std::reverse(path.begin(), path.end());
  if (search.mended) {
    // Mending looks at cells; here is made sure that nothing new stands between two of them.
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (!isClear(path[i - 1], path[i])) return false;
    }
  }
  taut_.pull(path);
  if (!plan.searched_anew && start != root) {
    const double from_root_m =
        wave.cost(cell) * map_.cell_size_m() + (plan.end - wave.placeOf(cell)).norm();
    const double least_m = from_root_m - (start - root).norm();
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
