// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/pilot.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kRings_m = 0.1;         // Between rings on which room to turn is looked for,
constexpr double kFurthestTurn_m = 1.5;  // up to so far off.
constexpr double kTurn_rad = 0.1;        // In such steps is looked whether it can turn.

}  // namespace

Pilot::Pilot(const OccupancyGrid& floor, const GlobalPlannerParams& paths,
             const LocalPlannerParams& drive, double give_up_s)
    : give_up_s_(give_up_s),
      room_(floor, 1.0),
      planner_(floor, paths),
      on_map_(floor, paths),
      local_planner_(drive) {}

void Pilot::setAround(const OccupancyGrid& things, const std::vector<float>& stood_s,
                      const std::vector<MovingPerson>& people) {
  things_ = &things;
  stood_s_ = &stood_s;
  resting_ = &people;
  discs_.clear();
  for (const MovingPerson& person : people) discs_.push_back({person.position, person.radius_m});
  planner_.setObstacles(discs_, &things);
  room_.setLayer({}, &things);
}

void Pilot::reset() {
  local_planner_.reset();
  arrival_.reset();
  round_to_.reset();
  stays_s_ = 0.0;
}

const GlobalPlan& Pilot::plan(const Vector2d& from, const Vector2d& to) {
  planner_.plan(from, to, plan_);
  return plan_;
}

double Pilot::takes_s(const FloorPose& from, const Vector2d& to) {
  const DriveLimits& drive = local_planner_.params().limits;
  double least_s = std::numeric_limits<double>::infinity();
  const auto compare = [&](const GlobalPlan& way, double waits_m) {
    const double turn_rad = way.path.size() < 2 ? 0.0 : std::abs(bearingOf(from, way.path[1]));
    least_s = std::min(
        least_s, (way.length_m + waits_m) / drive.max_speed_mps + turn_rad / drive.max_turn_radps);
  };
  // From near a place that it can not reach it does not see what it would from there.
  const bool is_open = plan(from.position, to).status == PlanStatus::kFound;
  if (is_open) compare(plan_, 0.0);
  if (things_ == nullptr) return least_s;
  on_map_.plan(from.position, to, through_);
  if (through_.status != PlanStatus::kFound) return least_s;
  if (!is_open || through_.length_m < plan_.length_m) compare(through_, barred_m(through_.path));
  return least_s;
}

PilotStep Pilot::step(const Intent& intent, const DriveState& robot,
                      const std::vector<MovingPerson>& people, Clearance sensed, Permission permits,
                      double elapsed_s) {
  const Vector2d& here = robot.pose.position;
  const auto room = [&](const Vector2d& p) { return std::min(room_.clearance(p), sensed(p)); };
  if (intent.is_new) reset();
  const double depart_m = local_planner_.params().depart_m;
  const bool was_there = arrival_ && intent.go_to && (arrival_->place - here).norm() < depart_m &&
                         (arrival_->goal - *intent.go_to).norm() < depart_m;
  const bool goes = intent.go_to && !(was_there && intent.look_at);
  const std::optional<Vector2d>& face = goes ? intent.keep_in_view : intent.look_at;
  std::optional<Vector2d> goal;
  if (goes) {
    goal = intent.go_to;
  } else if (face && !canTurnTo(*face, robot, room)) {
    goal = turningPlace(robot.pose, room);
  }
  const bool has_way = goal && findWay(here, *goal);
  if (!has_way) plan_.path.clear();

  PilotStep out;
  const LocalPlan now = local_planner_.step(robot.pose, robot.speed, plan_.path, room, people, face,
                                            permits, elapsed_s);
  out.velocity = now.command;
  out.goal = goal;
  if (goal) out.path = &plan_.path;
  if (goal || now.reason != DriveReason::kNoPath) out.reason = describe(now.reason);
  if (!goal) {
    out.velocity.turn_radps =
        std::clamp(now.command.turn_radps, -intent.most_turn_radps, intent.most_turn_radps);
  }
  const DriveLimits& drive = local_planner_.params().limits;
  stays_s_ += elapsed_s;
  if (!goes || (here - stays_at_).norm() > drive.radius_m) {
    stays_at_ = here;
    stays_s_ = 0.0;
  }
  if (goes) {
    // Between two ways that both seem open it could turn to and fro for ever.
    const bool gets_nowhere = stays_s_ > give_up_s_ + 2.0 * M_PI / drive.max_turn_radps;
    const bool is_stuck = now.blocked_s > give_up_s_ || gets_nowhere;
    const bool has_other_way = is_through_ && through_.found();
    const bool is_there = !has_way || now.status == DriveStatus::kArrived ||
                          (is_stuck && !has_other_way) ||
                          (*intent.go_to - here).norm() < intent.near_enough_m;
    if (is_stuck && has_other_way) {
      local_planner_.reset();
      stays_s_ = 0.0;
      round_to_ = intent.go_to;
    }
    arrival_.reset();
    if (is_there) arrival_ = Arrival{*intent.go_to, here};
  } else if (!was_there) {
    arrival_.reset();
  } else {
    arrival_->place = here;  // It may have gone aside to turn.
  }
  const bool stands = now.command.forward_mps == 0.0 && now.command.turn_radps == 0.0;
  out.outcome = {arrival_.has_value(), !goes && stands};
  // As near as can be: it looked from there once, and the way may be free by now.
  if (was_there && stands && (*intent.go_to - here).norm() > depart_m) arrival_.reset();
  return out;
}

// Around what stands. As the map has it where nothing leads around, or where the way round is
// longer than waiting is likely to take: what bars the way may have gone by then.
bool Pilot::findWay(const Vector2d& from, const Vector2d& to) {
  plan(from, to);
  is_through_ = false;
  if (things_ == nullptr) return plan_.found();
  if (round_to_ && (*round_to_ - to).norm() > local_planner_.params().depart_m) round_to_.reset();
  const double worth_m = local_planner_.params().limits.max_speed_mps * give_up_s_;
  if (plan_.found() && (round_to_ || plan_.length_m - (to - from).norm() < worth_m)) return true;
  on_map_.plan(from, to, through_);
  if (!through_.found()) return plan_.found();
  const double longer_m = plan_.length_m - through_.length_m;
  if (plan_.found() && (longer_m < worth_m || barred_m(through_.path) > longer_m)) return true;
  std::swap(plan_, through_);
  is_through_ = true;
  return true;
}

// What has stood for a time stands for as long again, once in two times: for so long the robot
// would wait at the worst of what bars a path, as the way that it drives in that time.
double Pilot::barred_m(const FloorPath& path) {
  const double speed_mps = local_planner_.params().limits.max_speed_mps;
  const double cell_m = planner_.clearance().cell_size_m();
  const double reach_m =
      planner_.params().robot_radius_m + planner_.params().safety_m + M_SQRT2 * cell_m;
  const double length_m = pathLength(path);
  barred_.take(path, path.front(), length_m + 1.0);
  double most_m = 0.0;
  const auto bar = [&](const Vector2d& place, double radius_m, double stood_s) {
    const double way_m = speed_mps * stood_s;
    if (!(way_m > most_m)) return;  // NaN too
    const PathAhead::Place on_path = barred_.locate(place);
    if (on_path.off_m > reach_m + radius_m) return;
    most_m = std::max(most_m, way_m - (length_m - on_path.left_m));
  };
  for (int y = 0; y < things_->height(); ++y) {
    for (int x = 0; x < things_->width(); ++x) {
      const GridCell cell{x, y};
      if (things_->at(cell) != Occupancy::kOccupied) continue;
      bar(things_->center(cell), M_SQRT1_2 * things_->cell_size_m(),
          (*stood_s_)[things_->index(cell)]);
    }
  }
  for (const MovingPerson& person : *resting_)
    bar(person.position, person.radius_m, person.rests_s);
  return most_m;
}

// A round robot touches nothing by turning.
bool Pilot::canTurnTo(const Vector2d& place, const DriveState& robot, Clearance room) const {
  const LocalPlannerParams& params = local_planner_.params();
  const DriveLimits& drive = params.limits;
  if (axisReach(drive) == 0.0 || turnToFace(drive, robot, place, params.facing) == 0.0) return true;
  const double need_m = std::min(params.margin_m, roomAround(drive, robot.pose, room));
  const double turn_rad = bearingOf(robot.pose, place);
  const int turns = static_cast<int>(std::ceil(std::abs(turn_rad) / kTurn_rad));
  for (int i = 1; i <= turns; ++i) {
    const FloorPose turned{robot.pose.position, robot.pose.yaw_rad + turn_rad * i / turns};
    if (!(roomAround(drive, turned, room) >= need_m)) return false;
  }
  return true;
}

// The nearest with room to turn, in rings about the robot; else that with the most room.
Vector2d Pilot::turningPlace(const FloorPose& pose, Clearance room) const {
  const LocalPlannerParams& params = local_planner_.params();
  const double need_m = turningRadius(params.limits) + params.margin_m;
  Vector2d best = pose.position;
  double most_m = room(best);
  for (double away_m = kRings_m; away_m < kFurthestTurn_m && most_m < need_m; away_m += kRings_m) {
    for (int i = 0; i < 16; ++i) {
      const double angle = M_PI + M_PI / 8.0 * i;  // behind it first: from there it came
      const Vector2d place = pose * Vector2d(away_m * Vector2d(std::cos(angle), std::sin(angle)));
      const double room_m = room(place);
      if (!(room_m > most_m)) continue;  // NaN too
      most_m = room_m;
      best = place;
    }
  }
  return best;
}

}  // namespace heel
