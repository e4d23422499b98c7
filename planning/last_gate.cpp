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
constexpr int kShares = 8;            // Shares of a velocity that are tried.
constexpr double kCell_m = 0.05;      // Of the camera's points,
constexpr int kCells = 48;            // so many on each side of a square about the robot.
constexpr double kSame_m = 0.1;       // So far apart two pictures may see one thing.
constexpr double kSurface_m = 0.05;   // So far behind a beam's end is the thing that it hit.
constexpr double kGrazed_m = 0.001;   // So far from where it stood, it stood there too.
constexpr double kThinnest_m = 0.02;  // The radius of the thinnest thing: a chair's leg.
constexpr double kGap_m = 0.01;       // Between places on the rim, at least.
constexpr double kWalks_mps = 1.2;    // Nobody walks faster.
constexpr double kRounding_m = 1e-9;
constexpr double kSoon_s = 1e-9;
constexpr double kOldest_s = 1.0;  // Of a motion from which to reckon.
constexpr std::size_t kThings = 4096;
constexpr std::size_t kPieces = 1024;

bool isNumber(const VelocityCommand& v) {
  return std::isfinite(v.forward_mps) && std::isfinite(v.turn_radps);
}

VelocityCommand scaled(const VelocityCommand& v, double share) {
  return {share * v.forward_mps, share * v.turn_radps};
}

double towards(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

VelocityCommand towards(const DriveLimits& limits, const VelocityCommand& from,
                        const VelocityCommand& to, double dt_s) {
  return {towards(from.forward_mps, to.forward_mps, limits.max_acceleration_mps2 * dt_s),
          towards(from.turn_radps, to.turn_radps, limits.max_turn_acceleration_radps2 * dt_s)};
}

VelocityCommand lesser(const VelocityCommand& a, const VelocityCommand& b) {
  return {std::min(a.forward_mps, b.forward_mps), std::min(a.turn_radps, b.turn_radps)};
}

VelocityCommand greater(const VelocityCommand& a, const VelocityCommand& b) {
  return {std::max(a.forward_mps, b.forward_mps), std::max(a.turn_radps, b.turn_radps)};
}

VelocityCommand middle(const VelocityCommand& a, const VelocityCommand& b) {
  return {0.5 * (a.forward_mps + b.forward_mps), 0.5 * (a.turn_radps + b.turn_radps)};
}

double most(double a, double b) { return std::max(std::abs(a), std::abs(b)); }

// How long a speed takes to get where it goes to; no time if it is there.
double untilThere(double from, double to, double acceleration) {
  const double left_s = std::abs(to - from) / acceleration;
  return left_s > kSoon_s ? left_s : std::numeric_limits<double>::infinity();
}

double untilThere(const DriveLimits& limits, const VelocityCommand& from,
                  const VelocityCommand& to) {
  return std::min(untilThere(from.forward_mps, to.forward_mps, limits.max_acceleration_mps2),
                  untilThere(from.turn_radps, to.turn_radps, limits.max_turn_acceleration_radps2));
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
  near_.reserve(2 * kThings);
  pieces_.reserve(kPieces);
  for (Look& look : looks_) look.stamp_s = kNever;
  sent_.fill({kNever, {}});
}

// How many beams after the first a place is; the greatest is one before the first.
double LastGate::beamTo(const Look& look, const Vector2d& at) {
  constexpr double kTurn_rad = 2.0 * M_PI;
  const double sign = look.scan.step_rad < 0.0 ? -1.0 : 1.0;
  double angle = sign * (std::atan2(at.y(), at.x()) - look.scan.first_rad);
  angle -= kTurn_rad * std::floor(angle / kTurn_rad);
  return angle / (sign * look.scan.step_rad);
}

// Whether a beam ends beyond a distance.
bool LastGate::endsBeyond(const Look& look, double beam, double away_m) {
  const double turn = std::round(2.0 * M_PI / std::abs(look.scan.step_rad));
  if (beam >= turn) beam -= turn;
  if (!(beam < static_cast<double>(look.scan.ranges_m.size()))) return false;
  const auto range_m = static_cast<double>(look.scan.ranges_m[static_cast<std::size_t>(beam)]);
  return range_m > 0.0 && range_m > away_m;  // Not where it is not a number.
}

// Whether the beam next to a thing goes through it, or ends at it.
bool LastGate::sees(const Look& look, const Vector2d& thing) {
  const Vector2d at = look.turn * (thing - look.scanner);
  return endsBeyond(look, std::round(beamTo(look, at)), at.norm() - kSurface_m);
}

// Whether a look has seen that a place is free: both beams beside it end no nearer than `short_m`
// before it.
bool LastGate::sawFree(const Look& look, const Vector2d& place, double short_m) {
  const Vector2d at = look.turn * (place - look.scanner);
  const double beam = std::floor(beamTo(look, at)), away_m = at.norm() - short_m;
  return endsBeyond(look, beam, away_m) && endsBeyond(look, beam + 1.0, away_m);
}

// Of the ring of looks, the one that saw the last place is asked first.
bool LastGate::isSeen(const Vector2d& place, double short_m, double now_s) {
  const auto sawIt = [&](const Look& look) {
    return now_s - look.stamp_s <= params_.remembers_s && sawFree(look, place, short_m);
  };
  if (sawIt(looks_[saw_])) return true;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    saw_ = (newest_ + looks_.size() - i) % looks_.size();
    if (sawIt(looks_[saw_])) return true;
  }
  return false;
}

// How what is seen at a place has come there. Where the look before saw nothing, something came,
// from the nearest that it saw; else it stands.
Vector2d LastGate::velocityOf(const Vector2d& place, const Look& before, double dt_s) {
  if (!(dt_s <= kOldest_s) || !sawFree(before, place, -kSurface_m)) return Vector2d::Zero();
  const Vector2d at = before.turn * (place - before.scanner);
  const double reach_m = kWalks_mps * dt_s;
  Vector2d came = Vector2d::Zero();
  double least2 = reach_m * reach_m;
  for (std::size_t i = 0; i < before.scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(before.scan.ranges_m[i]);
    if (!(std::abs(range_m - at.norm()) < reach_m)) continue;
    const double angle = before.scan.angle(i);
    const Vector2d by = at - range_m * Vector2d(std::cos(angle), std::sin(angle));
    if (by.squaredNorm() >= least2) continue;
    least2 = by.squaredNorm();
    came = by;
  }
  return before.turn.transpose() * came / dt_s;
}

void LastGate::addScan(const LaserScan& scan, const FloorPose& base, double stamp_s) {
  if (!(stamp_s > looks_[newest_].stamp_s) || scan.step_rad == 0.0) return;
  // As many looks as there is room for, evenly over the time that they are known.
  const double apart_s = params_.remembers_s / static_cast<double>(looks_.size() - 1);
  const Look& before = looks_[(newest_ + looks_.size() - 1) % looks_.size()];
  if (looks_[newest_].stamp_s - before.stamp_s >= apart_s) newest_ = (newest_ + 1) % looks_.size();
  Look& look = looks_[newest_];
  const FloorPose scanner = base * params_.T_base_scanner;
  look.scanner = scanner.position;
  look.turn = Eigen::Rotation2Dd(-scanner.yaw_rad).toRotationMatrix();
  look.stamp_s = stamp_s;
  look.scan.first_rad = scan.first_rad;
  look.scan.step_rad = scan.step_rad;
  look.scan.ranges_m.assign(scan.ranges_m.begin(), scan.ranges_m.end());
  beside_m_ = besideView(scan);
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) {
                                 return stamp_s - thing.seen_s > params_.remembers_s ||
                                        (thing.by_laser && sees(look, thing.place));
                               }),
                things_.end());
  const Look& earlier = looks_[(newest_ + looks_.size() - 1) % looks_.size()];
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m > 0.0 && range_m < 2.0 * reach_m_)) continue;
    const double angle = scan.angle(i);
    const Vector2d place = scanner * Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    keep({place, stamp_s, true, true, velocityOf(place, earlier, stamp_s - earlier.stamp_s)});
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
    keep({placeOf(cell), stamp_s, false, cell.is_sure, Vector2d::Zero()});
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

// What can be touched, and how near it may come. What walks may also stop: it is there twice.
void LastGate::approach(const Vector2d& robot, double reach_m, double then_s, double now_s) {
  near_.clear();
  const double body_m = params_.limits.radius_m;
  double nearest_m = body_m + params_.margin_m;
  for (const Thing& thing : things_) {
    if (now_s - thing.seen_s > params_.remembers_s) continue;
    if (!thing.velocity.isZero()) {
      const Vector2d then = thing.place + (then_s - thing.seen_s) * thing.velocity;
      near_.push_back({then, (then - robot).norm(), thing.velocity});
    }
    const double away2 = (thing.place - robot).squaredNorm();
    if (away2 > reach_m * reach_m) continue;
    const double away_m = std::sqrt(away2);
    if (away_m >= body_m) nearest_m = std::min(nearest_m, away_m);
    near_.push_back({thing.place, away_m, Vector2d::Zero()});
  }
  allow_m_ = nearest_m;
}

// Whether a thing surely comes no nearer while the robot drives a piece of its way: it is behind
// the robot, wherever in the piece that is and however it is turned.
bool LastGate::recedes(const Piece& piece, double along_m, double aside_m) {
  if (!piece.moves) return true;
  if (piece.turned_rad > 1.0) return false;
  const double cosine = 1.0 - 0.5 * piece.turned_rad * piece.turned_rad;  // or more
  const double aside = (std::abs(aside_m) + piece.aside_m) * piece.turned_rad;
  return (!piece.backs && (piece.first_m - along_m) * cosine >= aside) ||
         (!piece.advances && (along_m - piece.last_m) * cosine >= aside);
}

// What it touches, it never drives towards; all else stays as far off as is allowed, or recedes.
bool LastGate::isFree() const {
  const double body_m = params_.limits.radius_m;
  return std::all_of(near_.begin(), near_.end(), [&](const Near& thing) {
    const bool touches = thing.away_m < body_m;
    double safe_m = touches ? kNever : thing.away_m - allow_m_;  // so far it can drive anyhow
    const double walks_mps = thing.velocity.norm();
    for (const Piece& piece : pieces_) {
      const double nearer_m = piece.driven_m + walks_mps * piece.time_s;  // or less
      if (nearer_m <= safe_m) continue;
      const Vector2d to = thing.place + piece.time_s * thing.velocity - piece.from;
      const double along_m = to.dot(piece.way);
      const double aside_m = piece.way.x() * to.y() - piece.way.y() * to.x();
      const double off_m = std::max({0.0, piece.first_m - along_m, along_m - piece.last_m});
      const double away_m = std::sqrt(off_m * off_m + aside_m * aside_m) - piece.aside_m;
      if (!touches && away_m >= allow_m_ - kRounding_m) {
        safe_m = nearer_m + away_m - allow_m_;
      } else if (!recedes(piece, along_m, aside_m)) {
        return false;
      }
    }
    return true;
  });
}

// What a robot that stands can not see of its way straight on: the strips along both sides of the
// body, so wide, as far ahead as its scanner's first and last beam leave them.
double LastGate::besideView(const LaserScan& scan) const {
  const double body_m = params_.limits.radius_m;
  const double yaw_rad = params_.T_base_scanner.yaw_rad;
  const double first_rad = yaw_rad + scan.first_rad;
  const double last_rad = yaw_rad + scan.angle(scan.ranges_m.size()) - scan.step_rad;
  const double half_rad = std::min(std::abs(first_rad), std::abs(last_rad));
  if (half_rad + 2.0 * std::abs(scan.step_rad) >= M_PI) return 0.0;
  const double ahead_m =
      params_.T_base_scanner.position.x() + body_m / std::tan(std::max(half_rad, kRounding_m));
  const double within_m = std::clamp(ahead_m, 0.0, body_m);
  return body_m - std::sqrt(body_m * body_m - within_m * within_m);
}

// Whether the half of the body's rim that is in front has been seen free, or is where the body
// stood at `start`. Things are `allow_m_` or more off the body's middle: so the rim is drawn half
// of what they leave outside of the body, and a beam may end half of it before the rim.
bool LastGate::isRimSeen(const Vector2d& start, const Vector2d& middle, const Vector2d& front,
                         double body_m, double stood_m, double now_s) {
  const double spare_m = 0.5 * (allow_m_ - params_.limits.radius_m);
  const double step_rad = M_PI / std::ceil(M_PI * body_m / rimStep());
  const Eigen::Matrix2d step = Eigen::Rotation2Dd(step_rad).toRotationMatrix();
  Vector2d ray(front.y(), -front.x());  // from the right to the left
  for (double turned = 0.0; turned < M_PI + 0.5 * step_rad; turned += step_rad) {
    const bool stood_there = (middle + body_m * ray - start).squaredNorm() <= stood_m * stood_m;
    if (!stood_there && !isSeen(middle + (body_m + spare_m) * ray, spare_m, now_s)) return false;
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
bool LastGate::isSeenAhead(const Vector2d& start, double now_s) {
  const double apart_m = rimStep();
  for (const double sign : {1.0, -1.0}) {
    const auto goes = [&](const Piece& p) { return sign > 0.0 ? p.advances : p.backs; };
    // Forwards it never creeps on blindly: the scanner looks there.
    const double stood_m =
        params_.limits.radius_m + (sign > 0.0 ? std::max(kGrazed_m, beside_m_) : kGrazed_m);
    double looked_m = kNever;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      const bool ends = i + 1 == pieces_.size() || !goes(pieces_[i + 1]);
      if (!goes(piece) || (!ends && piece.driven_m - looked_m < apart_m)) continue;
      looked_m = piece.driven_m;
      const double along_m =
          (sign > 0.0 ? piece.last_m : piece.first_m) + (ends ? sign * params_.margin_m : 0.0);
      if (!isRimSeen(start, piece.from + along_m * piece.way, sign * piece.way,
                     params_.limits.radius_m + piece.aside_m, stood_m, now_s)) {
        return false;
      }
    }
  }
  return true;
}

// What the wheels may obey at a time, any command that was the newest within the latency, and
// until when that is so.
LastGate::Obeyed LastGate::obeyed(double time_s, const Sent* planned) const {
  Obeyed out{std::numeric_limits<double>::infinity(), {}, {}};
  double ends_s = std::numeric_limits<double>::infinity();
  bool is_any = false;
  const std::size_t plans = planned == nullptr ? 0 : 2;
  for (std::size_t i = 0; i < sent_.size() + plans; ++i) {
    const Sent& sent = i < plans
                           ? planned[plans - 1 - i]
                           : sent_[(sent_newest_ + sent_.size() - (i - plans)) % sent_.size()];
    const double left_s = ends_s + params_.wheels_latency_s;
    ends_s = sent.stamp_s;
    if (sent.stamp_s > time_s + kSoon_s) {
      out.until_s = sent.stamp_s;
      continue;
    }
    if (is_any && left_s <= time_s + kSoon_s) break;
    out.least = is_any ? lesser(out.least, sent.velocity) : sent.velocity;
    out.most = is_any ? greater(out.most, sent.velocity) : sent.velocity;
    out.until_s = std::min(out.until_s, left_s);
    is_any = true;
  }
  return out;
}

// Odometry tells the mean speed of a while, and late; what was sent, what the speed is by now.
void LastGate::believe(const VelocityCommand& measured, double at_s) {
  double time_s = std::max(believed_s_, at_s - params_.remembers_s);
  while (time_s < at_s - kSoon_s) {
    const Obeyed command = obeyed(time_s, nullptr);
    const double until_s = std::min(at_s, command.until_s);
    least_ = towards(params_.limits, least_, command.least, until_s - time_s);
    most_ = towards(params_.limits, most_, command.most, until_s - time_s);
    time_s = until_s;
  }
  believed_s_ = time_s;
  slow_ = lesser(measured, least_);
  fast_ = greater(measured, most_);
}

// Of what can still be obeyed.
double LastGate::fastestSent(double then_s) const {
  double top_mps = 0.0;
  double ends_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    const Sent& sent = sent_[(sent_newest_ + sent_.size() - i) % sent_.size()];
    if (ends_s + params_.wheels_latency_s < then_s - kSoon_s) break;
    top_mps = std::max(top_mps, std::abs(sent.velocity.forward_mps));
    ends_s = sent.stamp_s;
  }
  return top_mps;
}

// All ways from the last odometry through the commands that were sent, this one, and the brakes.
// A speed that goes towards a greater command never falls below one that goes towards a lesser: so
// both speeds are always between two of them, `slow` and `fast`. The way in the middle is followed,
// and e, how far any other is from it along its heading and aside of it: with d the difference in
// heading and w the middle's turn
//   e_along' = v cos d - v_middle + w e_aside,  e_aside' = v sin d - w e_along.
void LastGate::layOut(const VelocityCommand& velocity, const FloorPose& from, double then_s,
                      double now_s) {
  const DriveLimits& limits = params_.limits;
  const std::array<Sent, 2> planned{{{now_s, velocity}, {now_s + limits.period_s, {}}}};
  const double brakes_s = now_s + limits.period_s + params_.wheels_latency_s;
  VelocityCommand slow = slow_, fast = fast_;
  FloorPose pose = from;
  double time_s = then_s, along_m = 0.0, aside_m = 0.0, off_rad = 0.0, driven_m = 0.0;
  const auto rolls = [&] {
    return most(slow.forward_mps, fast.forward_mps) > 1e-9 ||
           most(slow.turn_radps, fast.turn_radps) > 1e-9;
  };
  pieces_.clear();
  while (time_s < brakes_s - kSoon_s || rolls()) {
    const Obeyed command = obeyed(time_s, planned.data());
    // Pieces in which each speed changes evenly.
    const double dt_s =
        std::min({kStep_s, command.until_s - time_s, untilThere(limits, slow, command.least),
                  untilThere(limits, fast, command.most)});
    const VelocityCommand next_slow = towards(limits, slow, command.least, dt_s);
    const VelocityCommand next_fast = towards(limits, fast, command.most, dt_s);
    const VelocityCommand begin = middle(slow, fast), end = middle(next_slow, next_fast);
    const VelocityCommand mean = middle(begin, end);
    const VelocityCommand wide =
        middle({fast.forward_mps - slow.forward_mps, fast.turn_radps - slow.turn_radps},
               {next_fast.forward_mps - next_slow.forward_mps,
                next_fast.turn_radps - next_slow.turn_radps});
    const double top_mps = std::max(most(slow.forward_mps, next_slow.forward_mps),
                                    most(fast.forward_mps, next_fast.forward_mps));
    const double turn_rad = dt_s * most(begin.turn_radps, end.turn_radps);
    const double way_m = dt_s * top_mps;
    const double faster_mps = end.forward_mps - begin.forward_mps;
    // The bounds of e grow by their rates, by what the chord of an arc leaves out of a way whose
    // speeds change, and as the heading turns one into the other.
    off_rad += 0.5 * wide.turn_radps * dt_s;
    const double along = along_m + 0.5 * wide.forward_mps * dt_s + 0.5 * way_m * off_rad * off_rad +
                         0.5 * way_m * turn_rad * turn_rad;
    const double aside = aside_m + way_m * off_rad + way_m * turn_rad * turn_rad * turn_rad / 6.0 +
                         dt_s * dt_s / 12.0 *
                             (std::abs(mean.forward_mps * (end.turn_radps - begin.turn_radps)) +
                              std::abs(mean.turn_radps * faster_mps));
    along_m = along + turn_rad * aside;
    aside_m = aside + turn_rad * along;
    driven_m += way_m;
    const FloorPose next = alongArc(pose, mean.forward_mps * dt_s, mean.turn_radps * dt_s);
    const double half_rad = pose.yaw_rad + 0.5 * mean.turn_radps * dt_s;
    Piece piece;
    piece.from = pose.position;
    piece.way = {std::cos(half_rad), std::sin(half_rad)};
    piece.driven_m = driven_m;
    piece.time_s = time_s + dt_s - then_s;
    piece.turned_rad = turn_rad + off_rad;
    piece.advances = fast.forward_mps > 0.0 || next_fast.forward_mps > 0.0;
    piece.backs = slow.forward_mps < 0.0 || next_slow.forward_mps < 0.0;
    piece.moves = piece.advances || piece.backs;
    // Where it turns back within the piece it has been a little further.
    const double beyond_m =
        begin.forward_mps * end.forward_mps < 0.0 ? std::abs(faster_mps) * dt_s / 8.0 : 0.0;
    const double chord_m = (next.position - pose.position).dot(piece.way);
    const double spare_m = along_m + turn_rad * aside_m + beyond_m;
    piece.first_m = std::min(chord_m, 0.0) - spare_m;
    piece.last_m = std::max(chord_m, 0.0) + spare_m;
    piece.aside_m = aside_m + turn_rad * along_m + 0.5 * way_m * turn_rad;
    pieces_.push_back(piece);
    slow = next_slow;
    fast = next_fast;
    pose = next;
    time_s += dt_s;
  }
}

GateReason LastGate::judge(const VelocityCommand& velocity, const FloorPose& from, double then_s,
                           double now_s) {
  layOut(velocity, from, then_s, now_s);
  if (!isFree()) return GateReason::kThing;
  return isSeenAhead(from.position, now_s) ? GateReason::kFree : GateReason::kUnseen;
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
    believe(now.speed, then_s);
    const double top_mps = std::max({most(slow_.forward_mps, fast_.forward_mps),
                                     std::abs(wanted.forward_mps), fastestSent(then_s)});
    const double until_brakes_s = age_s + params_.limits.period_s + params_.wheels_latency_s;
    approach(now.pose.position,
             params_.limits.radius_m + params_.margin_m +
                 stoppingDistance(params_.limits, top_mps, until_brakes_s),
             then_s, now_s);
    const auto passes = [&](const VelocityCommand& velocity) {
      const GateReason reason = judge(velocity, now.pose, then_s, now_s);
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
