// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/taut_path.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

/// Halvings when a tangent is looked for, and rounds of pulling.
constexpr int kHalvings = 6, kRounds = 1;
/// Bends below this (cosine) are as good as straight.
constexpr double kStraight = 0.995;

double bendCosine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d in = b - a, out = c - b;
  const double norms = in.norm() * out.norm();
  return norms > 0.0 ? in.dot(out) / norms : 1.0;
}

}  // namespace

void TautPath::pull(FloorPath& path) {
  if (path.size() < 3) return;
  skipAhead(path);
  for (int round = 0; round < kRounds; ++round) {
    slide(path);
    std::reverse(path.begin(), path.end());
    slide(path);
    std::reverse(path.begin(), path.end());
    cutBends(path);
  }
  skipAhead(path);
}

void TautPath::widen(FloorPath& path, double room_m) {
  const double step_m = 0.25 * map_->cell_size_m();
  const auto most = static_cast<int>(room_m / step_m);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    Eigen::Vector2d place = path[i];
    double room = map_->clearance(place);
    for (int step = 0; step < most && room < radius_m_ + room_m; ++step) {
      const Eigen::Vector2d next = place + step_m * awayFrom(place);
      const double next_room = map_->clearance(next);
      if (next_room < room + 0.3 * step_m) break;  // The middle, between two things.
      if (!isClear(path[i - 1], next) || !isClear(next, path[i + 1])) break;
      place = next;
      room = next_room;
    }
    path[i] = place;
  }
}

/// The way in which room grows, of length 1; 0 where it grows in none.
Eigen::Vector2d TautPath::awayFrom(const Eigen::Vector2d& place) const {
  const double step_m = 0.5 * map_->cell_size_m();
  const Eigen::Vector2d x(step_m, 0.0), y(0.0, step_m);
  const Eigen::Vector2d slope(map_->clearance(place + x) - map_->clearance(place - x),
                              map_->clearance(place + y) - map_->clearance(place - y));
  return slope.norm() > 0.0 ? Eigen::Vector2d(slope.normalized()) : slope;
}

/// From each point goes straight to the farthest that it finds in sight.
void TautPath::skipAhead(FloorPath& path) {
  const std::size_t last = path.size() - 1;
  next_.clear();
  next_.push_back(path.front());
  for (std::size_t at = 0; at < last;) {
    if (isClear(path[at], path[last])) {
      next_.push_back(path[last]);
      break;
    }
    std::size_t seen = at + 1, hidden = last, stride = 1;
    while (seen + stride < last) {
      if (!isClear(path[at], path[seen + stride])) {
        hidden = seen + stride;
        break;
      }
      seen += stride;
      stride *= 2;
    }
    while (hidden - seen > 1) {
      const std::size_t middle = (seen + hidden) / 2;
      (isClear(path[at], path[middle]) ? seen : hidden) = middle;
    }
    next_.push_back(path[seen]);
    at = seen;
  }
  path.swap(next_);
}

double TautPath::seenShare(const Eigen::Vector2d& eye, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) const {
  if (isClear(eye, to)) return 1.0;
  double seen = 0.0, hidden = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (seen + hidden);
    (isClear(eye, from + middle * (to - from)) ? seen : hidden) = middle;
  }
  return seen;
}

/// Moves each bend on along its second leg for as long as the point before it is in sight.
void TautPath::slide(FloorPath& path) {
  next_.clear();
  next_.push_back(path.front());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d eye = next_.back();
    const double share = seenShare(eye, path[i], path[i + 1]);
    if (share < 1.0) next_.push_back(path[i] + share * (path[i + 1] - path[i]));
  }
  next_.push_back(path.back());
  path.swap(next_);
}

/// Cuts each bend's corner off along a tangent, by the same length on both legs.
void TautPath::cutBends(FloorPath& path) {
  next_.clear();
  next_.push_back(path.front());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Eigen::Vector2d in = next_.back() - path[i], out = path[i + 1] - path[i];
    // The next bend may cut its share of the leg too.
    const double leg = std::min(in.norm(), i + 2 < path.size() ? 0.5 * out.norm() : out.norm());
    if (bendCosine(next_.back(), path[i], path[i + 1]) > kStraight || leg <= 0.0) {
      next_.push_back(path[i]);
      continue;
    }
    const Eigen::Vector2d back = in.normalized() * leg, on = out.normalized() * leg;
    double cut = 0.0, kept = 1.0;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (cut + kept);
      (isClear(path[i] + middle * back, path[i] + middle * on) ? cut : kept) = middle;
    }
    if (cut == 0.0) {
      next_.push_back(path[i]);
      continue;
    }
    next_.push_back(path[i] + cut * back);
    next_.push_back(path[i] + cut * on);
  }
  next_.push_back(path.back());
  path.swap(next_);
}

}  // namespace heel
