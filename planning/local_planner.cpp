// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/local_planner.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoWorse_m = 1e-6;
constexpr double kTouches_m = 0.05;  // Who will be so near is touched, as far as one can tell.
constexpr double kComes_mps = 0.15;
constexpr double kStands_mps = 0.02;
constexpr double kStands_radps = 0.05;
constexpr double kFine_mps = 0.001;  // An allowed speed is known to this.
/// A robot that waits for longer tries to turn to its path first.
constexpr double kTurnsFirstAfter_s = 0.5;
/// A long body that waits for longer backs off.
constexpr double kBacksAfter_s = 1.0;

bool isFinite(const MovingPerson& p) {
  return p.position.allFinite() && p.velocity.allFinite() && std::isfinite(p.radius_m) &&
         p.radius_m >= 0.0;
}

bool drives(const VelocityCommand& c) { return std::abs(c.forward_mps) > kStands_mps; }

/// The room around the body; none where nobody knows.
double roomAt(const DriveLimits& limits, const FloorPose& pose, const Clearance& clearance) {
  const double room_m = roomAround(limits, pose, clearance);
  return std::isnan(room_m) ? -kInfinite : room_m;
}

/// No point of the body moves further between two poses of a future.
double wayBetween(const DriveLimits& limits, const FloorPose& a, const FloorPose& b) {
  return (b.position - a.position).norm() +
         axisReach(limits) * std::abs(wrapped(b.yaw_rad - a.yaw_rad));
}

}  // namespace

const char* describe(DriveStatus status) {
  static constexpr std::array<const char*, 5> kTexts = {"moving", "turning", "stopped", "blocked",
                                                        "arrived"};
  return kTexts[static_cast<std::size_t>(status)];
}

const char* describe(DriveReason reason) {
  static constexpr std::array<const char*, 13> kTexts = {"on the way",
                                                         "turns to the path",
                                                         "at the goal",
                                                         "turns to look",
                                                         "no path",
                                                         "gives way to a person",
                                                         "backs off",
                                                         "a person is in the way",
                                                         "an obstacle is in the way",
                                                         "pose or speed is not finite",
                                                         "the path is not finite",
                                                         "a person's motion is not finite",
                                                         "the room around the robot is not known"};
  return kTexts[static_cast<std::size_t>(reason)];
}

LocalPlanner::LocalPlanner(const LocalPlannerParams& params) : params_(params) {
  checkLimits(params.limits);
  const double steps = params.horizon_s / params.limits.period_s;
  if (!(steps >= 5.0) || !(steps <= 1000.0)) {
    throw std::invalid_argument("a horizon must be 5 to 1000 control periods long");
  }
  for (const double value :
       {params.margin_m, params.people_margin_m, params.slow_gap_m, params.walks_mps,
        params.appears_mps, params.reacts_s, params.least_speed_mps, params.give_way_gap_m,
        params.give_way_s, params.look_away_s, params.arrive_m,
        params.depart_m - params.arrive_m}) {
    if (!(value >= 0.0)) throw std::invalid_argument("a local planner's parameter is negative");
  }
  const long held = std::lround(params.reacts_s / params.limits.period_s);
  held_ = static_cast<std::size_t>(std::max(held, 1L));
  futures_.steps = static_cast<std::size_t>(std::lround(steps));
  gaps_m_.resize(futures_.steps);
}

void LocalPlanner::expect(const std::vector<Vector2d>& hidden) {
  hidden_.clear();
  for (const Vector2d& place : hidden) {
    hidden_.push_back({place, Vector2d::Zero(), MovingPerson().radius_m, params_.appears_mps});
  }
}

void LocalPlanner::reset() {
  last_ = {};
  arrived_ = false;
  blocked_s_ = waited_s_ = backs_s_ = 0.0;
}

LocalPlan LocalPlanner::step(const FloorPose& pose, const VelocityCommand& speed,
                             const std::vector<Vector2d>& path, Clearance clearance,
                             const std::vector<MovingPerson>& people,
                             const std::optional<Vector2d>& face, Permission permits,
                             std::optional<double> since_last_s) {
  const double elapsed_s = since_last_s.value_or(params_.limits.period_s);
  DriveScene scene{{pose, speed}, last_, &path_, {}, &people, 0.0, face};
  if (face && !face->allFinite()) scene.face.reset();
  LocalPlan plan;
  if (const auto fault = findFault(scene, path)) {
    reset();
    plan.reason = *fault;
    return plan;
  }
  gap_m_ = roomAt(params_.limits, pose, clearance);
  plan.gap_m = gap_m_;
  plan.people_gap_m = roomToPeople(people, params_.limits, pose, 0.0);
  scene.people_room_m = plan.people_gap_m - kNoWorse_m;
  if (gap_m_ == -kInfinite) {
    reset();
    plan.reason = DriveReason::kNoClearance;
    return plan;
  }

  path_.clear();
  if (!hasArrived(path, pose.position)) {
    const double reach = params_.limits.max_speed_mps * params_.horizon_s + 0.7;
    path_.take(path, pose.position, reach);
    scene.start = path_.locate(pose.position);
  }
  const bool threatened = isThreatened(scene, plan.people_gap_m);
  DriveScores weights = params_.terms.weights;
  if (waited_s_ > kBacksAfter_s && params_.limits.front_m > params_.limits.back_m) {
    backs_s_ = (params_.limits.front_m - params_.limits.back_m) / params_.limits.max_reverse_mps;
    waited_s_ = 0.0;  // Then it looks again for a way ahead.
  }
  const bool backs = backs_s_ > 0.0 && !path_.empty();
  backs_s_ = std::max(backs_s_ - elapsed_s, 0.0);
  if (threatened || backs) {  // To make room comes before getting on, and before ease.
    weights[static_cast<std::size_t>(DriveTerm::kProgress)] = 0.0;
    weights[static_cast<std::size_t>(DriveTerm::kSmooth)] *= 0.1;
  }
  if (waited_s_ > params_.look_away_s) weights[static_cast<std::size_t>(DriveTerm::kView)] = 0.0;
  layOut(scene, threatened, backs);
  plan.options = futures_.size();

  const double drives_mps = std::max(std::abs(speed.forward_mps), kStands_mps);
  double least = kInfinite;
  for (std::size_t i = 0; i < futures_.size(); ++i) {
    const Braking braking = brake(scene, futures_.commands[i], clearance);
    if (!braking.admissible) continue;
    const std::size_t clear = measure(scene, i, clearance);
    const DriveOption option{futures_.row(i), gaps_m_.data(), futures_.steps, clear,
                             futures_.commands[i]};
    const DriveScores costs = driveCosts(params_.limits, params_.terms, scene, option);
    const double cost = total(costs, weights);
    if (!(cost < least)) continue;
    const VelocityCommand command = slowed(scene, futures_.commands[i], braking.gap_m);
    if (std::abs(futures_.commands[i].forward_mps) > drives_mps && !drives(command)) continue;
    const bool stands = command.forward_mps == 0.0 && command.turn_radps == 0.0;
    if (!stands && !permits(command)) continue;
    least = cost;
    plan.costs = costs;
    plan.command = command;
  }
  explain(scene, plan, threatened, elapsed_s);
  last_ = plan.command;
  return plan;
}

std::optional<DriveReason> LocalPlanner::findFault(const DriveScene& scene,
                                                   const std::vector<Vector2d>& path) const {
  const DriveState& now = scene.now;
  if (!now.pose.position.allFinite() || !std::isfinite(now.pose.yaw_rad) ||
      !std::isfinite(now.speed.forward_mps) || !std::isfinite(now.speed.turn_radps)) {
    return DriveReason::kBadPose;
  }
  if (!std::all_of(path.begin(), path.end(), [](const Vector2d& p) { return p.allFinite(); })) {
    return DriveReason::kBadPath;
  }
  if (!std::all_of(scene.people->begin(), scene.people->end(), isFinite)) {
    return DriveReason::kBadPeople;
  }
  return std::nullopt;
}

bool LocalPlanner::hasArrived(const std::vector<Vector2d>& path, const Vector2d& position) {
  if (path.empty()) {
    arrived_ = false;
    return true;  // There is nowhere to go.
  }
  const double off = (path.back() - position).norm();
  arrived_ = off < (arrived_ ? params_.depart_m : params_.arrive_m);
  return arrived_;
}

bool LocalPlanner::isThreatened(const DriveScene& scene, double room_m) const {
  if (room_m < 0.5 * params_.people_margin_m) return true;
  const FloorPose& pose = scene.now.pose;
  for (const MovingPerson& p : *scene.people) {
    const Vector2d to = pose.position - p.position;
    if (p.velocity.dot(to) <= kComes_mps * to.norm()) continue;
    if (roomToWay(p, params_.limits, pose, params_.give_way_s) < params_.give_way_gap_m)
      return true;
  }
  return false;
}

void LocalPlanner::layOut(const DriveScene& scene, bool threatened, bool backs) {
  const DriveLimits& limits = params_.limits;
  futures_.clear();
  if (path_.empty()) {
    const double turn = scene.face ? turnToFace(limits, scene.now, *scene.face, params_.facing) : 0;
    addHeld(limits, scene.now, {0.0, turn}, futures_);
  } else if (!backs) {
    for (const double aside : {0.0, -0.2, 0.2, -0.4, 0.4, -0.65, 0.65}) {
      for (const double share : {1.0, 0.5}) {
        addPursuit(limits, scene.now, path_,
                   {share * limits.max_speed_mps, std::max(0.35, 0.7 * std::abs(aside)), aside},
                   futures_);
      }
    }
    addPursuit(limits, scene.now, path_, {limits.max_speed_mps, 0.2, 0.0}, futures_);
    addPursuit(limits, scene.now, path_, {0.25 * limits.max_speed_mps, 0.2, 0.0}, futures_);
    // Beside a thing that any way but straight along the path comes nearer to.
    if (waited_s_ > kTurnsFirstAfter_s) {
      Pursuit turning{limits.max_speed_mps, 0.2};
      turning.turns_first = true;
      addPursuit(limits, scene.now, path_, turning, futures_);
    }
    for (const double share : {1.0, 0.6, 0.3}) {
      for (const double turn : {0.0, -0.2, 0.2, -0.5, 0.5, -1.0, 1.0}) {
        addHeld(limits, scene.now, {share * limits.max_speed_mps, turn * limits.max_turn_radps},
                futures_);
      }
    }
    addHeld(limits, scene.now, {0.0, 0.0}, futures_);
    for (const double turn : {-0.4, 0.4, -1.0, 1.0}) {
      addHeld(limits, scene.now, {0.0, turn * limits.max_turn_radps}, futures_);
    }
  }
  const bool is_short =
      !path_.empty() && scene.start.left_m < limits.max_reverse_mps * params_.horizon_s;
  if (threatened || backs || is_short) {
    for (const double turn : {0.0, -0.3, 0.3, -0.7, 0.7}) {
      addHeld(limits, scene.now, {-limits.max_reverse_mps, turn * limits.max_turn_radps}, futures_);
    }
  }

  // How near people come if the robot stands still, for as long as any braking can last.
  const double slowest = std::max(std::abs(scene.now.speed.forward_mps), limits.max_speed_mps) /
                             limits.max_braking_mps2 +
                         std::max(std::abs(scene.now.speed.turn_radps), limits.max_turn_radps) /
                             limits.max_turn_acceleration_radps2;
  const auto most = static_cast<std::size_t>(std::ceil(slowest / limits.period_s)) + 2 + held_;
  staying_gap_m_.resize(most);
  for (std::size_t i = 0; i < most; ++i) {
    staying_gap_m_[i] = roomToWays(*scene.people, limits, scene.now.pose,
                                   static_cast<double>(i + 1) * limits.period_s);
  }
}

LocalPlanner::Braking LocalPlanner::brake(const DriveScene& scene, const VelocityCommand& command,
                                          Clearance clearance) const {
  const DriveLimits& limits = params_.limits;
  Braking out{kInfinite, kInfinite, false};
  DriveState state = scene.now;
  std::size_t step = 0;
  const auto rolls = [&] {
    return std::abs(state.speed.forward_mps) > 1e-9 || std::abs(state.speed.turn_radps) > 1e-9;
  };
  for (; step < staying_gap_m_.size() && (step < held_ || rolls()); ++step) {
    state = driven(limits, state, step < held_ ? command : VelocityCommand{}, limits.period_s);
    const double way = wayBetween(limits, scene.now.pose, state.pose);
    // The room shrinks by no more than the way gone; look only where that doesn't settle it.
    const bool far = gap_m_ - way > std::max(params_.slow_gap_m, params_.margin_m);
    out.gap_m = std::min(out.gap_m, far ? gap_m_ - way : roomAt(limits, state.pose, clearance));
    out.people_gap_m =
        std::min(out.people_gap_m, roomToWays(*scene.people, limits, state.pose,
                                              static_cast<double>(step + 1) * limits.period_s));
  }
  const double staying = staying_gap_m_[step - 1];
  out.admissible =
      (out.gap_m >= params_.margin_m || out.gap_m >= gap_m_ - kNoWorse_m) &&
      (out.people_gap_m >= params_.people_margin_m || out.people_gap_m >= staying - kNoWorse_m);
  return out;
}

std::size_t LocalPlanner::measure(const DriveScene& scene, std::size_t option,
                                  Clearance clearance) {
  const FloorPose* poses = futures_.row(option);
  const DriveLimits& limits = params_.limits;
  std::size_t clear = futures_.steps;
  double known = gap_m_;
  const double least_m = std::min(kTouches_m, scene.people_room_m);
  FloorPose there = scene.now.pose;
  for (std::size_t i = 0; i < futures_.steps; ++i) {
    const double moved = wayBetween(limits, there, poses[i]);
    double gap = known - moved;
    if (gap < params_.terms.comfort_m && moved > 0.0) {
      gap = known = roomAt(limits, poses[i], clearance);
      there = poses[i];
    }
    gaps_m_[i] = gap;
    const double t = limits.period_s * static_cast<double>(i + 1);
    const bool touches = gap < 0.0 || (t <= params_.terms.foresight_s &&
                                       roomToPeople(*scene.people, limits, poses[i], t) < least_m);
    if (touches && clear == futures_.steps) clear = i;
  }
  return clear;
}

VelocityCommand LocalPlanner::slowed(const DriveScene& scene, const VelocityCommand& command,
                                     double gap_m) const {
  const double most = params_.limits.max_speed_mps;
  const double share =
      params_.slow_gap_m > 0.0 ? std::clamp(gap_m / params_.slow_gap_m, 0.0, 1.0) : 1.0;
  double allowed = params_.least_speed_mps + share * (most - params_.least_speed_mps);
  for (const MovingPerson& person : *scene.people) {
    allowed = std::min(allowed, allowedTowards(scene, person, params_.walks_mps, command));
  }
  for (const MovingPerson& person : hidden_) {
    const double towards_mps = allowedTowards(scene, person, params_.appears_mps, command);
    // Not slower, or it never passes a corner.
    allowed = std::min(allowed, std::max(towards_mps, params_.least_speed_mps));
  }
  const double speed = std::abs(command.forward_mps);
  if (speed <= allowed) return command;
  return {allowed / speed * command.forward_mps,
          allowed / speed * command.turn_radps};  // Same arc.
}

// How far somebody comes who starts at a speed (below 0: away) and may gain another.
double LocalPlanner::comes(double speed_mps, double walks_mps, double in_s) {
  const double gains_mps = std::max(walks_mps - speed_mps, 0.0);
  const double gaining_s = std::min(in_s, gains_mps / kWalkersGain_mps2);
  return speed_mps * in_s + kWalkersGain_mps2 * gaining_s * (in_s - 0.5 * gaining_s);
}

// They may come straight at the robot, which drives on for reacts_s, brakes, and stands when they
// are there. Until then it turns: what counts is the way in which it drives most towards them.
double LocalPlanner::allowedTowards(const DriveScene& scene, const MovingPerson& person,
                                    double walks_mps, const VelocityCommand& command) const {
  const DriveLimits& limits = params_.limits;
  const FloorPose& pose = scene.now.pose;
  const Vector2d to = person.position - axisOf(limits, pose).nearest(person.position);
  const double away_m = to.norm(), brakes_mps2 = limits.max_braking_mps2;
  const double way = command.forward_mps < 0.0 ? -1.0 : 1.0;
  const Vector2d ahead = way * Vector2d(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
  const double bearing = std::atan2(ahead.x() * to.y() - ahead.y() * to.x(), ahead.dot(to));
  const double turns =
      command.turn_radps * (params_.reacts_s + std::abs(command.forward_mps) / brakes_mps2);
  const double share =
      std::cos(bearing - std::clamp(bearing, std::min(turns, 0.0), std::max(turns, 0.0)));
  if (!(share > 0.0)) return kInfinite;
  const double comes_mps = person.gait_mps - person.velocity.dot(to) / away_m;
  const double room_m = away_m - limits.radius_m - person.radius_m;
  const auto stands = [&](double speed_mps) {
    const double brakes_s = speed_mps / brakes_mps2;
    return comes(comes_mps, walks_mps, params_.reacts_s + brakes_s) +
               share * speed_mps * (params_.reacts_s + 0.5 * brakes_s) <=
           room_m;
  };
  double allowed_mps = 0.0;
  for (double step = limits.max_speed_mps; step > kFine_mps; step *= 0.5) {
    if (stands(allowed_mps + step)) allowed_mps += step;
  }
  // It passes slowly beside people, and comes nearer no faster than who stands.
  return std::max(allowed_mps, std::min(params_.least_speed_mps, 0.5 * kStands_mps / share));
}

void LocalPlanner::explain(const DriveScene& scene, LocalPlan& plan, bool threatened,
                           double elapsed_s) {
  const VelocityCommand& c = plan.command;
  const bool has_way = !path_.empty();
  const bool moves = drives(c);
  const bool turns = std::abs(c.turn_radps) > kStands_radps;
  if (c.forward_mps < 0.0) {
    plan.status = DriveStatus::kMoving;
    plan.reason = threatened ? DriveReason::kGivesWay : DriveReason::kBacksOff;
  } else if (moves) {
    plan.status = DriveStatus::kMoving;
    plan.reason = DriveReason::kOnTheWay;
  } else if (!has_way) {
    plan.status =
        arrived_ ? DriveStatus::kArrived : (turns ? DriveStatus::kTurning : DriveStatus::kStopped);
    plan.reason =
        turns ? DriveReason::kFaces : (arrived_ ? DriveReason::kAtGoal : DriveReason::kNoPath);
  } else if (turns) {
    plan.status = DriveStatus::kTurning;
    plan.reason = DriveReason::kTurnsToPath;
  } else {
    plan.status = DriveStatus::kBlocked;
    // Whether it is people who are in the way: would the room to them be too little soon?
    const double soon =
        roomToWays(*scene.people, params_.limits, scene.now.pose, params_.terms.foresight_s);
    plan.reason = soon < 2.0 * params_.terms.people_comfort_m ? DriveReason::kPersonInWay
                                                              : DriveReason::kObstacleInWay;
  }
  const bool waits = has_way && !moves;
  const double progress_cost = plan.costs[static_cast<std::size_t>(DriveTerm::kProgress)];
  const bool turning_to_way = plan.status == DriveStatus::kTurning && progress_cost < 0.9;
  blocked_s_ = waits && !turning_to_way ? blocked_s_ + elapsed_s : 0.0;
  waited_s_ = waits ? waited_s_ + elapsed_s : 0.0;
  plan.blocked_s = blocked_s_;
}

}  // namespace heel
