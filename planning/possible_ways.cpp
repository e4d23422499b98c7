// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/possible_ways.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr double kNeverSent = -std::numeric_limits<double>::infinity();
constexpr double kStep_s = 0.02;
constexpr double kSoon_s = 1e-9;
constexpr double kLongest_s = 4.0;  // To reckon a speed from: any is reached by then.
constexpr std::size_t kPieces = 1024;

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

// How long a speed takes to get where it goes to; forever if it is there.
double untilThere(double from, double to, double acceleration) {
  const double left_s = std::abs(to - from) / acceleration;
  return left_s > kSoon_s ? left_s : std::numeric_limits<double>::infinity();
}

double untilThere(const DriveLimits& limits, const VelocityCommand& from,
                  const VelocityCommand& to) {
  const EvenChange forward = changeOf(limits, from.forward_mps, to.forward_mps);
  return std::min(untilThere(from.forward_mps, forward.to, forward.rate),
                  untilThere(from.turn_radps, to.turn_radps, limits.max_turn_acceleration_radps2));
}

}  // namespace

PossibleWays::PossibleWays(const DriveLimits& limits, double latency_s)
    : limits_(limits), latency_s_(latency_s), believed_s_(kNeverSent) {
  pieces_.reserve(kPieces);
  sent_.fill({kNeverSent, {}});
}

void PossibleWays::send(const VelocityCommand& velocity, double now_s) {
  sent_newest_ = (sent_newest_ + 1) % sent_.size();
  sent_[sent_newest_] = {now_s, velocity};
}

// What the wheels may obey at a time, any command that was the newest within the latency, and
// until when that is so.
PossibleWays::Obeyed PossibleWays::obeyed(double time_s, const Sent* planned) const {
  Obeyed out{std::numeric_limits<double>::infinity(), {}, {}};
  double ends_s = std::numeric_limits<double>::infinity();
  bool is_any = false;
  const std::size_t plans = planned == nullptr ? 0 : 2;
  for (std::size_t i = 0; i < sent_.size() + plans; ++i) {
    const Sent& sent = i < plans
                           ? planned[plans - 1 - i]
                           : sent_[(sent_newest_ + sent_.size() - (i - plans)) % sent_.size()];
    const double left_s = ends_s + latency_s_;
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
void PossibleWays::believe(const VelocityCommand& measured, double at_s) {
  double time_s = std::max(believed_s_, at_s - kLongest_s);
  while (time_s < at_s - kSoon_s) {
    const Obeyed command = obeyed(time_s, nullptr);
    const double until_s = std::min(at_s, command.until_s);
    least_ = speedAfter(limits_, least_, command.least, until_s - time_s);
    most_ = speedAfter(limits_, most_, command.most, until_s - time_s);
    time_s = until_s;
  }
  believed_s_ = time_s;
  slow_ = lesser(measured, least_);
  fast_ = greater(measured, most_);
}

double PossibleWays::fastest_mps(double then_s) const {
  double top_mps = most(slow_.forward_mps, fast_.forward_mps);
  double ends_s = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    const Sent& sent = sent_[(sent_newest_ + sent_.size() - i) % sent_.size()];
    if (ends_s + latency_s_ < then_s - kSoon_s) break;
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
const std::vector<WayPiece>& PossibleWays::layOut(const VelocityCommand& velocity,
                                                  const FloorPose& from, double then_s,
                                                  double now_s) {
  const std::array<Sent, 2> planned{{{now_s, velocity}, {now_s + limits_.period_s, {}}}};
  const double brakes_s = now_s + limits_.period_s + latency_s_;
  const double reach_m = axisReach(limits_);
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
        std::min({kStep_s, command.until_s - time_s, untilThere(limits_, slow, command.least),
                  untilThere(limits_, fast, command.most)});
    const VelocityCommand next_slow = speedAfter(limits_, slow, command.least, dt_s);
    const VelocityCommand next_fast = speedAfter(limits_, fast, command.most, dt_s);
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
    const double top_radps = std::max(most(slow.turn_radps, next_slow.turn_radps),
                                      most(fast.turn_radps, next_fast.turn_radps));
    driven_m += way_m + reach_m * top_radps * dt_s;
    const FloorPose next = alongArc(pose, mean.forward_mps * dt_s, mean.turn_radps * dt_s);
    const double half_rad = pose.yaw_rad + 0.5 * mean.turn_radps * dt_s;
    WayPiece piece;
    piece.from = pose.position;
    piece.way = {std::cos(half_rad), std::sin(half_rad)};
    piece.driven_m = driven_m;
    piece.time_s = time_s + dt_s - then_s;
    piece.turned_rad = turn_rad + off_rad;
    piece.advances = fast.forward_mps > 0.0 || next_fast.forward_mps > 0.0;
    piece.backs = slow.forward_mps < 0.0 || next_slow.forward_mps < 0.0;
    piece.swings = reach_m * top_radps > 0.0;
    // Where it turns back within the piece it has been a little further.
    const double beyond_m =
        begin.forward_mps * end.forward_mps < 0.0 ? std::abs(faster_mps) * dt_s / 8.0 : 0.0;
    const double chord_m = (next.position - pose.position).dot(piece.way);
    const double spare_m = along_m + turn_rad * aside_m + beyond_m;
    // The axis, turned off the way, is no longer along it, and aside by the sine.
    const double cosine = std::max(1.0 - 0.5 * piece.turned_rad * piece.turned_rad, -1.0);
    piece.first_m =
        std::min(chord_m, 0.0) - spare_m + std::min(limits_.back_m, limits_.back_m * cosine);
    piece.last_m =
        std::max(chord_m, 0.0) + spare_m + std::max(limits_.front_m, limits_.front_m * cosine);
    piece.aside_m = aside_m + turn_rad * along_m + 0.5 * way_m * turn_rad +
                    reach_m * std::min(piece.turned_rad, 1.0);
    pieces_.push_back(piece);
    slow = next_slow;
    fast = next_fast;
    pose = next;
    time_s += dt_s;
  }
  return pieces_;
}

}  // namespace heel
