// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/last_gate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr double kStep_s = 0.02;
constexpr int kShares = 8;           // Shares of a velocity that are tried.
constexpr double kCell_m = 0.05;     // Of the camera's points,
constexpr int kCells = 48;           // so many on each side of a square about the robot.
constexpr double kSame_m = 0.1;      // So far apart two pictures may see one thing.
constexpr double kSurface_m = 0.05;  // So far behind a beam's end is the thing that it hit.
constexpr double kRounding_m = 1e-9;
constexpr double kSoon_s = 1e-9;
constexpr double kOldest_s = 1.0;  // Of a motion from which to reckon.
constexpr std::size_t kThings = 4096;

bool isNumber(const VelocityCommand& v) {
  return std::isfinite(v.forward_mps) && std::isfinite(v.turn_radps);
}

VelocityCommand scaled(const VelocityCommand& v, double share) {
  return {share * v.forward_mps, share * v.turn_radps};
}

double distanceToLine(const Vector2d& place, const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const double length2 = way.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((place - from).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (place - from - share * way).norm();
}

}  // namespace

const char* describe(GateReason reason) {
  static constexpr std::array<const char*, 4> kTexts = {"", "brakes before what it sees",
                                                        "does not go where it has not looked",
                                                        "does not know how it moves"};
  return kTexts[static_cast<std::size_t>(reason)];
}

LastGate::LastGate(const LastGateParams& params)
    : params_(params), cells_(kCells * kCells), points_s_(kNever), believed_s_(kNever) {
  checkLimits(params.limits);
  for (const double value :
       {params.wheels_latency_s, params.margin_m, params.remembers_s, params.camera_half_view_rad,
        params.camera_nearest_m, params.camera_range_m, params.min_points - 1.0}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw std::invalid_argument("a last gate's parameter is out of its range");
    }
  }
  // A scan a control period, and twice as long as a command can take to act.
  reach_m_ = params.limits.radius_m + params.margin_m +
             stoppingDistance(params.limits, params.limits.max_speed_mps,
                              2.0 * params.wheels_latency_s + 0.5);
  things_.reserve(kThings);
  near_.reserve(kThings);
  for (Look& look : looks_) look.stamp_s = kNever;
  sent_.fill({kNever, {}});
}

// Whether the look's beams go through a place, or end at it.
bool LastGate::sees(const Look& look, const Vector2d& place) {
  const LaserScan& scan = look.scan;
  const Vector2d at = look.scanner.inverse() * place;
  constexpr double kTurn_rad = 2.0 * M_PI;
  const double sign = scan.step_rad < 0.0 ? -1.0 : 1.0;
  double angle = sign * (std::atan2(at.y(), at.x()) - scan.first_rad);
  angle -= kTurn_rad * std::floor(angle / kTurn_rad);  // from the first beam on, in [0, 2 pi)
  const double step = sign * scan.step_rad;
  const double beam = std::fmod(std::round(angle / step), std::round(kTurn_rad / step));
  if (!(beam < static_cast<double>(scan.ranges_m.size()))) return false;
  const auto range_m = static_cast<double>(scan.ranges_m[static_cast<std::size_t>(beam)]);
  return range_m > 0.0 && at.norm() < range_m + kSurface_m;  // Not where it is not a number.
}

bool LastGate::isSeen(const Vector2d& place, double now_s) const {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const Look& look = looks_[(newest_ + looks_.size() - i) % looks_.size()];
    if (now_s - look.stamp_s > params_.remembers_s) return false;  // The others are older.
    if (sees(look, place)) return true;
  }
  return false;
}

void LastGate::addScan(const LaserScan& scan, const FloorPose& base, double stamp_s) {
  if (!(stamp_s > looks_[newest_].stamp_s) || scan.step_rad == 0.0) return;
  // As many looks as there is room for, evenly over the time that they are known.
  const double apart_s = params_.remembers_s / static_cast<double>(looks_.size() - 1);
  const Look& before = looks_[(newest_ + looks_.size() - 1) % looks_.size()];
  if (looks_[newest_].stamp_s - before.stamp_s >= apart_s) newest_ = (newest_ + 1) % looks_.size();
  Look& look = looks_[newest_];
  look.scanner = base * params_.T_base_scanner;
  look.stamp_s = stamp_s;
  look.scan.first_rad = scan.first_rad;
  look.scan.step_rad = scan.step_rad;
  look.scan.ranges_m.assign(scan.ranges_m.begin(), scan.ranges_m.end());
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) {
                                 return stamp_s - thing.seen_s > params_.remembers_s ||
                                        (thing.by_laser && sees(look, thing.place));
                               }),
                things_.end());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m > 0.0 && range_m < 2.0 * reach_m_)) continue;
    const double angle = scan.angle(i);
    const Vector2d place =
        look.scanner * Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    keep({place, stamp_s, true, true, 0.0, 0.0});
  }
}

void LastGate::addPoints(const std::vector<Eigen::Vector3f>& points, const FloorPose& base,
                         double stamp_s) {
  if (!(stamp_s > points_s_)) return;
  points_s_ = stamp_s;
  const FloorPose T_base_world = base.inverse();
  const auto isInView = [&](const Vector2d& place) {
    const Vector2d at = T_base_world * place - params_.camera_m;
    return std::abs(std::atan2(at.y(), at.x())) < params_.camera_half_view_rad &&
           at.norm() > params_.camera_nearest_m && at.norm() < params_.camera_range_m;
  };
  std::fill(cells_.begin(), cells_.end(), Cell{});
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2f at = point.head<2>();
    const Eigen::Vector2d cell = at.cast<double>().array() / kCell_m + kCells / 2.0;
    if (!((cell.array() >= 0.0).all() && (cell.array() < kCells).all())) continue;  // NaN too
    Cell& c =
        cells_[static_cast<std::size_t>(cell.y()) * kCells + static_cast<std::size_t>(cell.x())];
    if (c.points == 0 || at.norm() < c.nearest.norm()) c.nearest = at;
    ++c.points;
  }
  const auto placeOf = [&](const Cell& c) { return base * Vector2d(c.nearest.cast<double>()); };
  for (Cell& cell : cells_) {
    if (cell.points < params_.min_points) continue;
    cell.is_sure = std::any_of(things_.begin(), things_.end(), [&](const Thing& thing) {
      return !thing.by_laser && (thing.place - placeOf(cell)).norm() < kSame_m;
    });
  }
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) {
                                 return !thing.by_laser &&
                                        (!thing.is_sure || isInView(thing.place));
                               }),
                things_.end());
  for (const Cell& cell : cells_) {
    if (cell.points < params_.min_points) continue;
    keep({placeOf(cell), stamp_s, false, cell.is_sure, 0.0, 0.0});
  }
}

// Where there is no room for more, the oldest goes.
void LastGate::keep(const Thing& thing) {
  if (things_.size() >= kThings) things_.erase(things_.begin(), things_.begin() + kThings / 4);
  things_.push_back(thing);
}

double LastGate::clearance(const Vector2d& place) const {
  double least2 = std::numeric_limits<double>::infinity();
  for (const Thing& thing : things_) least2 = std::min(least2, (thing.place - place).squaredNorm());
  return std::sqrt(least2);
}

// What can be touched, and how near it may come.
void LastGate::approach(const Vector2d& robot, double now_s) {
  near_.clear();
  const double body_m = params_.limits.radius_m;
  double nearest_m = body_m + params_.margin_m;
  for (Thing& thing : things_) {
    if (now_s - thing.seen_s > params_.remembers_s) continue;
    thing.away_m = (thing.place - robot).norm();
    if (thing.away_m > reach_m_) continue;
    if (thing.away_m >= body_m) nearest_m = std::min(nearest_m, thing.away_m);
    near_.push_back(&thing);
  }
  // What the robot touches may come no nearer; else nothing may come nearer than the nearest is.
  for (Thing* thing : near_) thing->allow_m = std::min(thing->away_m, nearest_m);
}

bool LastGate::isFreeBetween(const FloorPose& from, const FloorPose& to) const {
  // An arc leaves its chord by no more than this.
  const double chord_m = (to.position - from.position).norm();
  const double bulge_m = 0.125 * chord_m * std::abs(wrapped(to.yaw_rad - from.yaw_rad));
  return std::all_of(near_.begin(), near_.end(), [&](const Thing* thing) {
    return distanceToLine(thing->place, from.position, to.position) - bulge_m >=
           thing->allow_m - kRounding_m;
  });
}

// The front of the body, in the direction in which it goes; the sides were the front before.
bool LastGate::isSeenAhead(const DriveState& state, const Vector2d& start, double now_s) const {
  const double body_m = params_.limits.radius_m;
  const double way_rad = state.pose.yaw_rad + (state.speed.forward_mps < 0.0 ? M_PI : 0.0);
  for (const double aside_rad : {0.0, 0.5, -0.5, 1.0, -1.0}) {
    const double angle = way_rad + aside_rad;
    const Vector2d rim = state.pose.position + body_m * Vector2d(std::cos(angle), std::sin(angle));
    if ((rim - start).norm() > body_m && !isSeen(rim, now_s)) return false;
  }
  return true;
}

// The command that was the newest at a time, and when the next was sent.
LastGate::Sent LastGate::sentAt(double time_s) const {
  double until_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    const Sent& sent = sent_[(sent_newest_ + sent_.size() - i) % sent_.size()];
    if (sent.stamp_s <= time_s + kSoon_s) return {until_s, sent.velocity};
    until_s = sent.stamp_s;
  }
  return {until_s, {}};
}

// Odometry tells the mean speed of a while, and late; what was sent, what the speed is by now.
DriveState LastGate::fastest(const DriveState& now, double at_s) {
  const double latency_s = params_.wheels_latency_s;
  double time_s = std::max(believed_s_, at_s - params_.remembers_s);
  while (time_s < at_s - kSoon_s) {
    const Sent sent = sentAt(time_s - latency_s);
    const double until_s = std::min(at_s, sent.stamp_s + latency_s);
    believed_.speed = driven(params_.limits, believed_, sent.velocity, until_s - time_s).speed;
    time_s = until_s;
  }
  believed_s_ = time_s;
  const auto faster = [](double a, double b) { return std::abs(a) > std::abs(b) ? a : b; };
  return {now.pose,
          {faster(now.speed.forward_mps, believed_.speed.forward_mps),
           faster(now.speed.turn_radps, believed_.speed.turn_radps)}};
}

// From the last odometry through the commands that were sent, this one, and the brakes.
GateReason LastGate::judge(const VelocityCommand& velocity, const DriveState& then, double then_s,
                           double now_s, double latency_s) const {
  const double begins_s = now_s + latency_s;
  const double brakes_s = now_s + params_.limits.period_s + params_.wheels_latency_s;
  DriveState state = then;
  double time_s = then_s;
  const auto rolls = [&] {
    return std::abs(state.speed.forward_mps) > 1e-9 || std::abs(state.speed.turn_radps) > 1e-9;
  };
  while (time_s < brakes_s - kSoon_s || rolls()) {
    Sent command{std::numeric_limits<double>::infinity(), {}};  // the brakes
    if (time_s < begins_s - kSoon_s) {
      command = sentAt(time_s - latency_s);
      command.stamp_s = std::min(command.stamp_s + latency_s, begins_s);
    } else if (time_s < brakes_s - kSoon_s) {
      command = {brakes_s, velocity};
    }
    const double until_s = std::min(time_s + kStep_s, command.stamp_s);
    const DriveState next = driven(params_.limits, state, command.velocity, until_s - time_s);
    if (!isFreeBetween(state.pose, next.pose)) return GateReason::kThing;
    if (next.speed.forward_mps != 0.0 && !isSeenAhead(next, then.pose.position, now_s)) {
      return GateReason::kUnseen;
    }
    state = next;
    time_s = until_s;
  }
  return GateReason::kFree;
}

// With each command as late as can be, and at once.
GateReason LastGate::judge(const VelocityCommand& velocity, const DriveState& then, double then_s,
                           double now_s) const {
  const GateReason late = judge(velocity, then, then_s, now_s, params_.wheels_latency_s);
  if (late != GateReason::kFree || params_.wheels_latency_s == 0.0) return late;
  return judge(velocity, then, then_s, now_s, 0.0);
}

GatedVelocity LastGate::pass(const VelocityCommand& wanted, const DriveState& now, double age_s,
                             double now_s) {
  GatedVelocity gated;
  if (!isNumber(wanted) || !isNumber(now.speed) || !now.pose.position.allFinite() ||
      !std::isfinite(now.pose.yaw_rad) || !std::isfinite(now_s) ||
      !(age_s >= 0.0 && age_s <= kOldest_s)) {
    gated.reason = GateReason::kBadMotion;
  } else {
    const double then_s = now_s - age_s;
    const DriveState then = fastest(now, then_s);
    approach(then.pose.position, now_s);
    const auto passes = [&](const VelocityCommand& velocity) {
      const GateReason reason = judge(velocity, then, then_s, now_s);
      if (reason == GateReason::kFree) gated.velocity = velocity;
      if (gated.reason == GateReason::kFree) gated.reason = reason;  // why not all of it
      return reason == GateReason::kFree;
    };
    const bool stands = wanted.forward_mps == 0.0 && wanted.turn_radps == 0.0;
    bool has_passed = stands;
    for (int i = kShares; i > 0 && !has_passed; --i) {
      has_passed = passes(scaled(wanted, static_cast<double>(i) / kShares));
    }
    if (!has_passed) passes({0.0, wanted.turn_radps});
  }
  sent_newest_ = (sent_newest_ + 1) % sent_.size();
  sent_[sent_newest_] = {now_s, gated.velocity};
  return gated;
}

}  // namespace heel
