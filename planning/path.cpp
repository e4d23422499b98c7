// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/path.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {

using Eigen::Vector2d;

constexpr double kThere_m = 0.05;
/// Not worth a turn on the spot.
constexpr double kStraightAhead_rad = 0.05;

double pathLength(const FloorPath& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

void resample(const FloorPath& path, double step_m, FloorPath& out) {
  if (!(step_m > 0.0)) throw std::invalid_argument("a path's step must be positive");
  out.clear();
  if (path.empty()) return;
  out.push_back(path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d piece = path[i] - path[i - 1];
    const int parts = static_cast<int>(std::ceil(piece.norm() / step_m - 1e-9));
    for (int k = 1; k < parts; ++k) out.push_back(path[i - 1] + piece * (double(k) / parts));
    if (parts > 0) out.push_back(path[i]);
  }
}

FloorPath resample(const FloorPath& path, double step_m) {
  FloorPath out;
  resample(path, step_m, out);
  return out;
}

void PathAhead::take(const std::vector<Vector2d>& path, const Vector2d& position, double reach_m) {
  points_.clear();
  // The nearest point of the polyline.
  std::size_t leg = 0;
  double share = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector2d side = path[i + 1] - path[i];
    const double length2 = side.squaredNorm();
    const double t =
        length2 > 0.0 ? std::clamp((position - path[i]).dot(side) / length2, 0.0, 1.0) : 0.0;
    const double off = (path[i] + t * side - position).squaredNorm();
    if (off < least - 1e-12) {
      least = off;
      leg = i;
      share = t;
    }
  }
  if (path.size() == 1) {
    points_.push_back(path.front());
    ends_at_goal_ = true;
    return;
  }
  Vector2d at = path[leg] + share * (path[leg + 1] - path[leg]);
  points_.push_back(at);
  const auto most = static_cast<std::size_t>(std::max(1.0, std::ceil(reach_m / kSpacing_m)));
  double due = kSpacing_m;
  for (std::size_t i = leg + 1; i < path.size() && points_.size() <= most;) {
    const double way = (path[i] - at).norm();
    if (way < due) {
      due -= way;
      at = path[i++];
    } else {
      at += due / way * (path[i] - at);
      points_.push_back(at);
      due = kSpacing_m;
    }
  }
  ends_at_goal_ = points_.size() <= most;
  if (ends_at_goal_) points_.push_back(path.back());
}

std::size_t PathAhead::advance(const Vector2d& point, std::size_t from) const {
  // A little further on may be nearer again, where the path bends.
  constexpr std::size_t kBeyond = 3;
  std::size_t best = from;
  double least = (points_[from] - point).squaredNorm();
  for (std::size_t i = from + 1; i < points_.size() && i <= best + kBeyond; ++i) {
    const double off = (points_[i] - point).squaredNorm();
    if (off < least) {
      least = off;
      best = i;
    }
  }
  return best;
}

PathAhead::Place PathAhead::locate(const Vector2d& point) const {
  Place out;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double off = (points_[i] - point).squaredNorm();
    if (off < least) {
      least = off;
      out.index = i;
    }
  }
  out.off_m = std::sqrt(least);
  out.direction_rad = direction(out.index);
  out.left_m = kSpacing_m * static_cast<double>(points_.size() - 1 - out.index);
  // Between the samples: how far past the nearest one, so that small steps count.
  const Vector2d ahead(std::cos(out.direction_rad), std::sin(out.direction_rad));
  const double past = (point - points_[out.index]).dot(ahead);
  if (std::abs(past) <= kSpacing_m) {
    const bool last = out.index + 1 == points_.size();
    if (!last || past < 0.0) {
      out.left_m = std::max(out.left_m - past, 0.0);
      out.off_m = std::sqrt(std::max(least - past * past, 0.0));
    }
  }
  return out;
}

double PathAhead::direction(std::size_t index) const {
  if (points_.size() < 2) return 0.0;
  const std::size_t a = index > 0 ? index - 1 : 0;
  const std::size_t b = std::min(index + 1, points_.size() - 1);
  const Vector2d way = points_[b] - points_[a];
  return std::atan2(way.y(), way.x());
}

void addPursuit(const DriveLimits& limits, const DriveState& now, const PathAhead& path,
                const Pursuit& pursuit, Trajectories& out) {
  const auto look = static_cast<std::size_t>(std::ceil(pursuit.look_m / PathAhead::kSpacing_m));
  const std::vector<Vector2d>& points = path.points();
  DriveState state = now;
  std::size_t index = 0;
  for (std::size_t step = 0; step < out.steps; ++step) {
    index = path.advance(state.pose.position, index);
    const std::size_t ahead = std::min(index + look, points.size() - 1);
    const double direction = path.direction(ahead);
    const double left =
        (points.back() - points[ahead]).norm() + (points[ahead] - state.pose.position).norm();
    // Back on the path towards its end, where the goal is.
    const double aside = pursuit.aside_m * (path.endsAtGoal() ? std::min(left, 1.0) : 1.0);
    const Vector2d to = points[ahead] +
                        aside * Vector2d(-std::sin(direction), std::cos(direction)) -
                        state.pose.position;
    const double angle =
        to.norm() < 1e-6 ? 0.0 : wrapped(std::atan2(to.y(), to.x()) - state.pose.yaw_rad);
    // Full speed up to 37 degrees off, none from 72 degrees on.
    double speed = pursuit.speed_mps * std::clamp((std::cos(angle) - 0.3) / 0.5, 0.0, 1.0);
    if (pursuit.turns_first && std::abs(angle) > kStraightAhead_rad) speed = 0.0;
    if (path.endsAtGoal()) speed = std::min(speed, 0.9 * speedToStopWithin(limits, left));
    VelocityCommand command{speed, std::clamp(pursuit.turn_gain * angle, -limits.max_turn_radps,
                                              limits.max_turn_radps)};
    // So near to the goal its direction says nothing.
    if (path.endsAtGoal() && left < kThere_m) command = {};
    if (step == 0) out.commands.push_back(command);
    state = driven(limits, state, command, limits.period_s);
    out.poses.push_back(state.pose);
  }
}

}  // namespace heel
