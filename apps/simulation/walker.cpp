// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/walker.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kArrived_m = 0.08;
constexpr double kTurnRate_radps = 3.0;
constexpr double kAcceleration_mps2 = 2.0;
constexpr double kForesight_s = 2.0;
constexpr double kReflex_s = 0.4;
constexpr double kPush_spm = 60.0;  // Cost of a push, per m/s.
constexpr double kBodyToWall_m = 0.2;
constexpr double kSideways_m = 0.15;  // Nobody's middle comes nearer to a wall, even sideways.
constexpr double kPatience_s = 1.5;  // Held up by the robot for so long, one makes room for it, ...
constexpr double kMakesRoom_s = 6.0;  // ... for so long,
constexpr double kHeldUp_m = 1.0;     // if it is this near;
constexpr double kRoom_m = 1.4;       // this far is far enough.
constexpr double kAside_mps = 0.4;
constexpr double kHair_m = 0.01;     // Who sees the robot comes no nearer to it than this.
constexpr double kBump_m = 0.01;     // Who does not runs into it by so much,
constexpr double kFeels_s = 3.0;     // and steps round it for so long.
constexpr double kMeets_s = 5.0;     // Who came back for the robot gives it so long to turn round.
constexpr double kGivesUp_s = 10.0;  // Someone who can't get to a place goes to the next.

/// When two discs touch if both keep their velocity; infinite if never.
double timeToTouch(const Vector2d& offset, const Vector2d& approach, double reach) {
  const double c = offset.squaredNorm() - reach * reach;
  const double b = offset.dot(approach);
  if (c <= 0.0) return std::numeric_limits<double>::infinity();  // See `closing`.
  const double a = approach.squaredNorm();
  const double root = b * b - a * c;
  if (b >= 0.0 || root <= 0.0) return std::numeric_limits<double>::infinity();
  return (-b - std::sqrt(root)) / a;
}

/// How fast two discs that touch already come closer [m/s].
double closing(const Vector2d& offset, const Vector2d& approach, double reach) {
  const double away = offset.norm();
  return away < reach ? std::max(-offset.dot(approach) / std::max(away, 1e-3), 0.0) : 0.0;
}

/// Whether nothing of the plan stands between two places.
bool isOpen(const FloorPlan& plan, const Vector2d& from, const Vector2d& to) {
  constexpr double kStep_m = 0.05;
  const double length_m = (to - from).norm();
  const Vector2d way = (to - from).normalized();
  double room_m = 0.0;
  for (double gone_m = kStep_m; gone_m < length_m; gone_m += std::max(room_m, kStep_m)) {
    room_m = plan.clearance(from + gone_m * way);
    if (room_m < 0.0) return false;
  }
  return true;
}

}  // namespace

Walker::Walker(const ScenePerson& person) : person_(&person) {
  pose_.position = person.start;
  pose_.yaw_rad = person.start_yaw_rad;
}

void Walker::finishStep() {
  waited_s_ = with_robot_s_ = 0.0;
  off_way_s_ = 0.0;
  back_to_.reset();
  ++step_;
  if (done() && person_->repeat) step_ = 0;
}

void Walker::step(double dt_s, const FloorPlan& plan, const FloorPlan& hiding,
                  const std::vector<Mover>& others, const Mover& robot) {
  pose_.time_s += dt_s;
  Vector2d wanted = Vector2d::Zero();
  if (!done()) {
    const PathStep& now = person_->path[step_];
    const Vector2d way = now.to - pose_.position;
    switch (now.kind) {
      case PathStep::Kind::kWalk:
        wanted = wayOn(dt_s, plan).normalized() * now.speed_mps;
        if (way.norm() < std::max(kArrived_m, now.speed_mps * dt_s)) finishStep();
        break;
      case PathStep::Kind::kWait:
        waited_s_ += dt_s;
        if (waited_s_ >= now.wait_s - 1e-9) finishStep();
        break;
      case PathStep::Kind::kWaitForRobot:
        wanted = waitForRobot(dt_s, hiding, robot.position);
        break;
      case PathStep::Kind::kFace: {
        const double yaw = std::atan2(way.y(), way.x());
        turnTo(yaw, dt_s);
        if (std::abs(wrapped(yaw - pose_.yaw_rad)) < 0.02) finishStep();
        break;
      }
    }
  }
  makes_room_s_ = std::max(makes_room_s_ - dt_s, 0.0);
  const double to_robot_m = (robot.position - pose_.position).norm();
  feels_s_ = std::max(feels_s_ - dt_s, 0.0);
  if (person_->sees_robot && stuck_s_ > kPatience_s && to_robot_m < kHeldUp_m) {
    makes_room_s_ = kMakesRoom_s;
    stuck_s_ = 0.0;
  }
  if (makes_room_s_ > 0.0) {
    wanted = to_robot_m < kRoom_m ? wayAside(plan, robot.position) : Vector2d::Zero();
  }
  const bool walks = !wanted.isZero();
  const Vector2d way = wanted.normalized();
  if (walks) wanted = chooseVelocity(wanted, plan, others, noticesRobot() ? nullptr : &robot);
  accelerate(dt_s, wanted);
  keepOff(dt_s, robot);
  keepOffThings(dt_s, plan);
  move(dt_s);
  stuck_s_ = walks && velocity_.dot(way) < 0.1 ? stuck_s_ + dt_s : std::max(stuck_s_ - dt_s, 0.0);
  if (std::max(stuck_s_, off_way_s_) > kGivesUp_s) {
    stuck_s_ = 0.0;
    finishStep();
  }
}

// Straight on. Who does not get on because a wall is between, for they stepped aside or were
// pushed, goes back to their way, or to a corner that they have passed, until the next one is in
// sight.
Vector2d Walker::wayOn(double dt_s, const FloorPlan& plan) {
  const Vector2d& here = pose_.position;
  Vector2d next = person_->path[step_].to;
  const bool is_off_way = (off_way_s_ > 0.0 || stuck_s_ > kPatience_s) && !isOpen(plan, here, next);
  off_way_s_ = is_off_way ? off_way_s_ + dt_s : 0.0;
  const Vector2d straight_on = next - here;
  if (!is_off_way) return straight_on;
  for (std::optional<std::size_t> at = step_; at;) {
    at = walkBefore(*at);
    const Vector2d passed = at ? person_->path[*at].to : person_->start;
    const Vector2d leg = next - passed;
    const double share = (here - passed).dot(leg) / std::max(leg.squaredNorm(), 1e-9);
    for (const Vector2d& place : {Vector2d(passed + std::clamp(share, 0.0, 1.0) * leg), passed}) {
      if ((place - here).norm() > kArrived_m && isOpen(plan, place, next) &&
          isOpen(plan, here, place)) {
        return place - here;
      }
    }
    next = passed;
  }
  return straight_on;
}

Vector2d Walker::waitForRobot(double dt_s, const FloorPlan& hiding, const Vector2d& robot) {
  if (!person_->sees_robot) {
    finishStep();
    return Vector2d::Zero();
  }
  if (back_to_) return comeBack(dt_s, hiding, robot);
  const PathStep& now = person_->path[step_];
  waited_s_ += dt_s;
  if (isWithRobot(hiding, robot)) {
    finishStep();
  } else if (waited_s_ >= now.patience_s) {
    if (now.comes_back) back_to_ = walkBefore(step_);
    if (!back_to_) finishStep();
  }
  return Vector2d::Zero();
}

bool Walker::isWithRobot(const FloorPlan& hiding, const Vector2d& robot) const {
  return (robot - pose_.position).norm() <= person_->path[step_].robot_within_m &&
         isOpen(hiding, pose_.position, robot);
}

// Corner by corner, to the beginning at most.
Vector2d Walker::comeBack(double dt_s, const FloorPlan& hiding, const Vector2d& robot) {
  if (with_robot_s_ > 0.0 || isWithRobot(hiding, robot)) {
    with_robot_s_ += dt_s;
    if (with_robot_s_ < kMeets_s) return Vector2d::Zero();
    step_ = *back_to_;
    finishStep();  // on from there
    return Vector2d::Zero();
  }
  const PathStep& back = person_->path[*back_to_];
  const Vector2d way = back.to - pose_.position;
  if (way.norm() >= std::max(kArrived_m, back.speed_mps * dt_s)) {
    return way.normalized() * back.speed_mps;
  }
  if (const auto before = walkBefore(*back_to_)) back_to_ = before;
  return Vector2d::Zero();
}

std::optional<std::size_t> Walker::walkBefore(std::size_t step) const {
  while (step > 0) {
    if (person_->path[--step].kind == PathStep::Kind::kWalk) return step;
  }
  return std::nullopt;
}

// Away from the robot, to where there is room.
Vector2d Walker::wayAside(const FloorPlan& plan, const Vector2d& robot) const {
  Vector2d best = Vector2d::Zero();
  double most = 0.0;
  for (int i = 0; i < 16; ++i) {
    const double angle = M_PI / 8.0 * i;
    const Vector2d way(std::cos(angle), std::sin(angle));
    const Vector2d there = pose_.position + 0.5 * way;
    const double room_m =
        std::min(plan.clearance(there), plan.clearance(pose_.position + 0.25 * way));
    const double gain_m = (there - robot).norm() - (pose_.position - robot).norm();
    if (room_m < kBodyToWall_m || gain_m + 0.3 * std::min(room_m, 0.6) <= most) continue;
    most = gain_m + 0.3 * std::min(room_m, 0.6);
    best = kAside_mps * way;
  }
  return best;
}

Vector2d Walker::chooseVelocity(const Vector2d& wanted, const FloorPlan& plan,
                                const std::vector<Mover>& others, const Mover* unseen) const {
  static constexpr std::array<double, 13> kTurns = {0.0,   -0.3, 0.3,  -0.6, 0.6,  -0.95, 0.95,
                                                    -1.35, 1.35, -1.8, 1.8,  -2.6, 2.6};
  const double speed = wanted.norm();
  Vector2d best = Vector2d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const double pace : {1.0, 0.55, 0.0}) {
    for (const double turn : kTurns) {
      if (pace == 0.0 && turn != 0.0) continue;
      const Vector2d velocity = pace * (Eigen::Rotation2Dd(turn) * wanted);
      // People keep right when they can: a little more is paid for a turn to the left.
      double cost = (velocity - wanted).norm() / speed + (turn > 0.0 ? 0.08 : 0.0);
      if (pace == 0.0) cost += 0.4 * stuck_s_;  // Nobody waits for ever.
      for (const Mover& other : others) {
        if (&other == unseen) continue;
        const Vector2d offset = other.position - pose_.position;
        const Vector2d approach = other.velocity - velocity;
        const double reach = other.radius_m + kRadius_m;
        const double touch = timeToTouch(offset, approach, reach);
        if (touch < kForesight_s) cost += 3.0 * (1.0 - touch / kForesight_s) + 0.5;
        if (touch < kReflex_s) cost += 10.0;  // Rather stand than bump into somebody.
        cost += kPush_spm * closing(offset, approach, reach);  // Least of all push them.
      }
      if (cost >= least) continue;
      const bool straight = turn == 0.0;
      if (!straight && plan.clearance(pose_.position + 0.35 * velocity) < kBodyToWall_m) continue;
      if (!straight && plan.clearance(pose_.position + 0.8 * velocity) < kBodyToWall_m) cost += 1.0;
      if (cost >= least) continue;
      least = cost;
      best = velocity;
      if (cost == 0.0) return best;  // Nobody is in the way.
    }
  }
  return best;
}

void Walker::accelerate(double dt_s, const Vector2d& wanted) {
  const Vector2d change = wanted - velocity_;
  const double most = kAcceleration_mps2 * dt_s;
  velocity_ += change.norm() > most ? Vector2d(change.normalized() * most) : change;
}

// Who sees the robot does not walk into it, however late; nobody walks through it.
void Walker::keepOff(double dt_s, const Mover& robot) {
  const Vector2d to = robot.position - pose_.position;
  const double gap_m = to.norm() - robot.radius_m - kRadius_m;
  const double room_m = person_->sees_robot ? gap_m - kHair_m : gap_m + kRobotRoom_m + kBump_m;
  if (!person_->sees_robot && gap_m + kRobotRoom_m <= 0.0) feels_s_ = kFeels_s;
  const Vector2d way = to.normalized();
  const double most_mps = std::max(room_m, 0.0) / dt_s;
  if (velocity_.dot(way) > most_mps) velocity_ += (most_mps - velocity_.dot(way)) * way;
}

// Nobody walks through a wall, but along it: twice, for what is beyond a corner.
void Walker::keepOffThings(double dt_s, const FloorPlan& plan) {
  constexpr double kApart_m = 0.01;
  for (int i = 0; i < 2; ++i) {
    const Vector2d next = pose_.position + velocity_ * dt_s;
    const double now_m = plan.clearance(pose_.position), next_m = plan.clearance(next);
    const double least_m = std::min(kSideways_m, now_m);
    if (next_m >= least_m) return;
    const Vector2d x(kApart_m, 0.0), y(0.0, kApart_m);
    const Vector2d away(plan.clearance(next + x) - plan.clearance(next - x),
                        plan.clearance(next + y) - plan.clearance(next - y));
    velocity_ += (least_m - next_m) / dt_s * away.normalized();
  }
}

void Walker::move(double dt_s) {
  pose_.position += velocity_ * dt_s;
  const double speed = velocity_.norm();
  if (speed > 0.05) turnTo(std::atan2(velocity_.y(), velocity_.x()), dt_s);
  pose_.speed_mps = speed;
  pose_.gait_rad = std::remainder(
      pose_.gait_rad + 2.0 * M_PI * speed * dt_s / strideLength(*person_, speed), 2.0 * M_PI);
}

void Walker::turnTo(double yaw_rad, double dt_s) {
  const double most = kTurnRate_radps * dt_s;
  pose_.yaw_rad =
      wrapped(pose_.yaw_rad + std::clamp(wrapped(yaw_rad - pose_.yaw_rad), -most, most));
}

}  // namespace heel
