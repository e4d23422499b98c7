// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/last_gate.hpp>
#include <heel/planning/surroundings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr int kShares = 8;             // Shares of a velocity that are tried.
constexpr double kGrazed_m = 0.001;    // So far from where it stood, it stood there too.
constexpr double kThinnest_m = 0.02;   // The radius of the thinnest thing: a chair's leg.
constexpr double kGap_m = 0.01;        // Between places on the rim, at least.
constexpr double kBeyondLegs_m = 0.2;  // So far beyond what a laser sees of legs is the body.
constexpr double kRounding_m = 1e-9;
constexpr double kOldest_s = 1.0;  // Of a motion from which to reckon.
// What a scan has seen free is free of who walks for so long: two scans, a quarter of a second
// late.
constexpr double kInView_s = 0.5;

bool isNumber(const VelocityCommand& v) {
  return std::isfinite(v.forward_mps) && std::isfinite(v.turn_radps);
}

VelocityCommand scaled(const VelocityCommand& v, double share) {
  return {share * v.forward_mps, share * v.turn_radps};
}

const LastGateParams& checked(const LastGateParams& params) {
  checkLimits(params.limits);
  for (const double value : {params.wheels_latency_s, params.margin_m}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw std::invalid_argument("LastGateParams: a parameter is out of its range");
    }
  }
  return params;
}

// What is further away can't touch the robot before it stands, walks though it may, with a scan a
// control period, and twice as long as a command can take to act.
double rangeFor(const LastGateParams& params) {
  const DriveLimits& limits = params.limits;
  const double acts_s = 2.0 * params.wheels_latency_s + 0.5;
  return axisReach(limits) + limits.radius_m + params.margin_m +
         stoppingDistance(limits, limits.max_speed_mps, acts_s) +
         kFastestWalk_mps * (acts_s + limits.max_speed_mps / limits.max_braking_mps2);
}

// Only a body that is not round swings.
double keptFor(const LastGateParams& params) {
  const bool swings = axisReach(params.limits) > 0.0;
  return swings ? turningRadius(params.limits) + params.margin_m : 0.0;
}

}  // namespace

const char* describe(GateReason reason) {
  static constexpr std::array<const char*, 4> kTexts = {"", "brakes before what it sees",
                                                        "does not go where it has not looked",
                                                        "does not know how it moves"};
  return kTexts[static_cast<std::size_t>(reason)];
}

LastGate::LastGate(const LastGateParams& params)
    : params_(checked(params)),
      sight_(params.sight, rangeFor(params), keptFor(params)),
      ways_(params.limits, params.wheels_latency_s) {
  near_.reserve(2 * RecentSight::kMostThings);
}

void LastGate::addScan(const LaserScan& scan, const FloorPose& base, double stamp_s) {
  sight_.addScan(scan, base, stamp_s);
}

void LastGate::addPoints(int camera, const std::vector<Eigen::Vector3f>& points,
                         const FloorPose& base, double stamp_s,
                         const std::vector<Vector2d>& steps) {
  sight_.addPoints(camera, points, base, stamp_s, steps);
}

// What can be touched, and how near it may come.
void LastGate::approach(const FloorLine& body, double reach_m) {
  near_.clear();
  const double body_m = params_.limits.radius_m;
  double nearest_m = body_m + params_.margin_m;
  for (const SeenThing& thing : sight_.things()) {
    const bool roams = thing.roams && thing.seen_s == sight_.newest_s();
    const double away2 = (thing.place - body.nearest(thing.place)).squaredNorm();
    const double around_m = thing.is_somebody ? kBeyondLegs_m : 0.0;
    if (!roams && away2 > (reach_m + around_m) * (reach_m + around_m)) continue;
    const double away_m = std::sqrt(away2);
    if (away_m >= body_m) nearest_m = std::min(nearest_m, away_m);
    near_.push_back({thing.place, away_m, roams ? thing.velocity : Vector2d::Zero(), roams,
                     around_m, thing.gait_mps, then_s_ - thing.seen_s});
  }
  allow_m_ = nearest_m;
}

// How far it can be from where it was seen, as it walked, some time after [m].
double LastGate::strays(const Near& thing, double after_s) const {
  if (!thing.roams) return thing.around_m;
  return thing.around_m + (thing.gait_mps + 0.5 * kWalkersGain_mps2 * after_s) * after_s;
}

// Whether a thing surely comes no nearer while the robot drives a piece of its way: it, and what it
// is a part of, is behind the robot, wherever in the piece that is and however it is turned.
bool LastGate::recedes(const WayPiece& piece, double along_m, double aside_m, double around_m) {
  if (!piece.advances && !piece.backs && !piece.swings) return true;
  if (piece.swings || piece.turned_rad > 1.0) return false;
  const double cosine = 1.0 - 0.5 * piece.turned_rad * piece.turned_rad;  // or more
  const double aside = (std::abs(aside_m) + around_m + piece.aside_m) * piece.turned_rad;
  return (!piece.backs && (piece.first_m - along_m - around_m) * cosine >= aside) ||
         (!piece.advances && (along_m - around_m - piece.last_m) * cosine >= aside);
}

// What it touches, it never drives towards; all else stays as far off as is allowed, or recedes.
bool LastGate::isFree(const std::vector<WayPiece>& pieces) const {
  const double body_m = params_.limits.radius_m;
  return std::all_of(near_.begin(), near_.end(), [&](const Near& thing) {
    const bool touches = thing.away_m < body_m;
    double safe_m = touches ? kNever : thing.away_m - allow_m_;  // so far it can drive anyhow
    const double walks_mps = thing.velocity.norm();
    for (const WayPiece& piece : pieces) {
      const double after_s = thing.age_s + piece.time_s;
      const double strays_m = strays(thing, after_s);
      const double nearer_m = piece.driven_m + walks_mps * after_s + strays_m;  // or less
      if (nearer_m <= safe_m) continue;
      const Vector2d to = thing.place + after_s * thing.velocity - piece.from;
      const double along_m = to.dot(piece.way);
      const double aside_m = piece.way.x() * to.y() - piece.way.y() * to.x();
      const double off_m = std::max({0.0, piece.first_m - along_m, along_m - piece.last_m});
      const double away_m = std::sqrt(off_m * off_m + aside_m * aside_m) - piece.aside_m - strays_m;
      if (!touches && away_m >= allow_m_ - kRounding_m) {
        safe_m = nearer_m + away_m - allow_m_;
      } else if (!recedes(piece, along_m, aside_m, thing.around_m)) {
        return false;
      }
    }
    return true;
  });
}

// Whether the half of the body's rim that is in front has been seen free, or is where the body
// stood at `start`. Things are `allow_m_` or more off the body's middle: so the rim is drawn half
// of what they leave outside of the body, and a beam may end half of it before the rim.
bool LastGate::isRimSeen(const FloorLine& start, const Vector2d& middle, const Vector2d& front,
                         double body_m, double stood_m, double since_s) {
  const double spare_m = 0.5 * (allow_m_ - params_.limits.radius_m);
  const double step_rad = M_PI / std::ceil(M_PI * body_m / rimStep());
  const Eigen::Matrix2d step = Eigen::Rotation2Dd(step_rad).toRotationMatrix();
  Vector2d ray(front.y(), -front.x());  // from the right to the left
  for (double turned = 0.0; turned < M_PI + 0.5 * step_rad; turned += step_rad) {
    const Vector2d rim = middle + body_m * ray;
    const bool stood_there = (rim - start.nearest(rim)).squaredNorm() <= stood_m * stood_m;
    if (!stood_there && !sight_.isSeen(middle + (body_m + spare_m) * ray, spare_m, since_s))
      return false;
    ray = step * ray;
  }
  return true;
}

// A thing that touches the body covers so much of that rim, or, where nothing is spared, is less
// than 1 mm into the body.
double LastGate::rimStep() const {
  const double body_m = params_.limits.radius_m;
  const double spare_m = 0.5 * (allow_m_ - body_m);
  const double bend_m = kThinnest_m * body_m / (kThinnest_m + body_m);
  return std::max(2.0 * std::sqrt(2.0 * spare_m * bend_m), kGap_m);
}

// What the body newly covers while it goes one way is what the front half of its rim sweeps. That
// is looked at in rows across the way; each end is taken further by the margin, or the robot could
// creep on where nothing is seen.
bool LastGate::isSeenAhead(const std::vector<WayPiece>& pieces) {
  const FloorLine start = axisOf(params_.limits, from_);
  const bool is_blind = now_s_ - sight_.newest_s() > params_.sight.remembers_s;
  const auto swings = [](const WayPiece& piece) { return piece.swings; };
  if (is_blind && std::any_of(pieces.begin(), pieces.end(), swings)) return false;
  const double apart_m = rimStep();
  const double beside_m = sight_.besideView(params_.limits.radius_m, params_.limits.front_m);
  for (const double sign : {1.0, -1.0}) {
    const auto goes = [&](const WayPiece& p) { return sign > 0.0 ? p.advances : p.backs; };
    // Forwards it never creeps on blindly: the scanner looks there.
    const double stood_m =
        params_.limits.radius_m + (sign > 0.0 ? std::max(kGrazed_m, beside_m) : kGrazed_m);
    const double since_s = now_s_ - (sign > 0.0 ? params_.sight.remembers_s : kInView_s);
    double looked_m = kNever;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const WayPiece& piece = pieces[i];
      const bool ends = i + 1 == pieces.size() || !goes(pieces[i + 1]);
      if (!goes(piece) || (!ends && piece.driven_m - looked_m < apart_m)) continue;
      looked_m = piece.driven_m;
      const double along_m =
          (sign > 0.0 ? piece.last_m : piece.first_m) + (ends ? sign * params_.margin_m : 0.0);
      if (!isRimSeen(start, piece.from + along_m * piece.way, sign * piece.way,
                     params_.limits.radius_m + piece.aside_m, stood_m, since_s)) {
        return false;
      }
    }
  }
  return true;
}

GateReason LastGate::judge(const VelocityCommand& velocity) {
  const std::vector<WayPiece>& pieces = ways_.layOut(velocity, from_, then_s_, now_s_);
  if (!isFree(pieces)) return GateReason::kThing;
  return isSeenAhead(pieces) ? GateReason::kFree : GateReason::kUnseen;
}

void LastGate::locate(const DriveState& now, double age_s, double now_s) {
  is_located_ = isNumber(now.speed) && now.pose.position.allFinite() &&
                std::isfinite(now.pose.yaw_rad) && std::isfinite(now_s) && age_s >= 0.0 &&
                age_s <= kOldest_s;
  if (!is_located_) return;
  from_ = now.pose;
  now_s_ = now_s;
  then_s_ = now_s - age_s;
  ways_.believe(now.speed, then_s_);
  const double top_mps = std::max(
      {params_.limits.max_speed_mps, params_.limits.max_reverse_mps, ways_.fastest_mps(then_s_)});
  const double until_brakes_s = age_s + params_.limits.period_s + params_.wheels_latency_s;
  approach(axisOf(params_.limits, from_),
           params_.limits.radius_m + params_.margin_m + 2.0 * axisReach(params_.limits) +
               stoppingDistance(params_.limits, top_mps, until_brakes_s));
}

bool LastGate::lets(const VelocityCommand& wanted) {
  return is_located_ && isNumber(wanted) &&
         judge(scaled(wanted, 1.0 / kShares)) == GateReason::kFree;
}

GatedVelocity LastGate::pass(const VelocityCommand& wanted, const DriveState& now, double age_s,
                             double now_s) {
  GatedVelocity gated;
  locate(now, age_s, now_s);
  if (!is_located_ || !isNumber(wanted)) {
    gated.reason = GateReason::kBadMotion;
  } else {
    const auto passes = [&](const VelocityCommand& velocity) {
      const GateReason reason = judge(velocity);
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
  ways_.send(gated.velocity, now_s);
  return gated;
}

}  // namespace heel
