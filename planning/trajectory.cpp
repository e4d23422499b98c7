// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/trajectory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kTurnEnds_rad = 0.05;    // No more than this is left of a turn that ends;
constexpr double kTurnBegins_rad = 0.12;  // a robot that stands turns only for more than this.

using Eigen::Vector2d;

constexpr double kDiscs = 2.0;      // In a radius of the axis: their rims leave 3.2 % of it out.
constexpr double kFinest_m = 1e-3;  // To which a body is fitted.

}  // namespace

void checkLimits(const DriveLimits& limits) {
  for (const double limit :
       {limits.radius_m, limits.max_speed_mps, limits.max_reverse_mps, limits.max_turn_radps,
        limits.max_acceleration_mps2, limits.max_braking_mps2, limits.max_turn_acceleration_radps2,
        limits.period_s}) {
    if (!(limit > 0.0) || !std::isfinite(limit)) {
      throw std::invalid_argument("a drive's limits must be positive");
    }
  }
  if (!(limits.back_m <= limits.front_m) || !std::isfinite(limits.front_m - limits.back_m)) {
    throw std::invalid_argument("a body's front must be before its back");
  }
}

DriveLimits withBodyAround(const std::vector<Vector2d>& corners, DriveLimits limits) {
  double narrowest_m = 0.0, roundest_m = 0.0;
  for (const Vector2d& corner : corners) {
    narrowest_m = std::max(narrowest_m, std::abs(corner.y()));
    roundest_m = std::max(roundest_m, corner.norm());
  }
  double least_m2 = std::numeric_limits<double>::infinity();
  const int steps = static_cast<int>(std::ceil((roundest_m - narrowest_m) / kFinest_m));
  for (int i = 0; i <= steps; ++i) {
    const double radius_m = std::min(narrowest_m + i * kFinest_m, roundest_m);
    double front_m = -roundest_m, back_m = roundest_m;
    for (const Vector2d& corner : corners) {
      const double along_m =
          std::sqrt(std::max(radius_m * radius_m - corner.y() * corner.y(), 0.0));
      front_m = std::max(front_m, corner.x() - along_m);
      back_m = std::min(back_m, corner.x() + along_m);
    }
    // A disc that holds all of them about any point of the axis has room to spare.
    if (front_m < back_m) front_m = back_m = 0.5 * (front_m + back_m);
    const double area_m2 = radius_m * (M_PI * radius_m + 2.0 * (front_m - back_m));
    if (area_m2 >= least_m2) continue;
    least_m2 = area_m2;
    limits.radius_m = radius_m;
    limits.front_m = front_m;
    limits.back_m = back_m;
  }
  return limits;
}

Vector2d FloorLine::nearest(const Vector2d& place) const {
  const Vector2d way = to - from;
  const double length2 = way.squaredNorm();
  return from +
         (length2 > 0.0 ? std::clamp((place - from).dot(way) / length2, 0.0, 1.0) : 0.0) * way;
}

double distanceBetween(const FloorLine& a, const FloorLine& b) {
  const auto sideOf = [](const FloorLine& line, const Vector2d& place) {
    const Vector2d way = line.to - line.from, off = place - line.from;
    return way.x() * off.y() - way.y() * off.x();
  };
  if (sideOf(a, b.from) * sideOf(a, b.to) < 0.0 && sideOf(b, a.from) * sideOf(b, a.to) < 0.0) {
    return 0.0;
  }
  return std::sqrt(std::min(
      {(a.nearest(b.from) - b.from).squaredNorm(), (a.nearest(b.to) - b.to).squaredNorm(),
       (b.nearest(a.from) - a.from).squaredNorm(), (b.nearest(a.to) - a.to).squaredNorm()}));
}

FloorLine axisOf(const DriveLimits& limits, const FloorPose& T_world_base) {
  return {T_world_base * Vector2d(limits.back_m, 0.0),
          T_world_base * Vector2d(limits.front_m, 0.0)};
}

double axisReach(const DriveLimits& limits) {
  return std::max(std::abs(limits.back_m), std::abs(limits.front_m));
}

double turningRadius(const DriveLimits& limits) { return axisReach(limits) + limits.radius_m; }

double roomAround(const DriveLimits& limits, const FloorPose& T_world_base, Clearance clearance) {
  const FloorLine axis = axisOf(limits, T_world_base);
  const Vector2d way = axis.to - axis.from;
  const double discs = std::ceil(way.norm() * kDiscs / limits.radius_m);
  double least_m = clearance(axis.from);
  for (double i = 1.0; i <= discs; ++i) {
    const double at_m = clearance(axis.from + i / discs * way);
    if (!(at_m >= least_m)) least_m = at_m;  // Nor where it is not a number.
    if (std::isnan(least_m)) return least_m;
  }
  if (discs == 0.0) return least_m - limits.radius_m;
  const double beside_m = 0.5 * way.norm() / discs;  // of the nearest disc's middle
  return std::sqrt(std::max(least_m * least_m - beside_m * beside_m, 0.0)) - limits.radius_m;
}

EvenChange changeOf(const DriveLimits& limits, double from_mps, double to_mps) {
  const bool stops = from_mps * to_mps < 0.0;
  const bool brakes = stops || std::abs(to_mps) < std::abs(from_mps);
  return {stops ? 0.0 : to_mps, brakes ? limits.max_braking_mps2 : limits.max_acceleration_mps2};
}

VelocityCommand speedAfter(const DriveLimits& limits, const VelocityCommand& from,
                           const VelocityCommand& to, double dt_s) {
  const auto towards = [](double a, double b, double most) {
    return a + std::clamp(b - a, -most, most);
  };
  const EvenChange first = changeOf(limits, from.forward_mps, to.forward_mps);
  const double left_s = dt_s - std::abs(first.to - from.forward_mps) / first.rate;
  const double forward_mps =
      first.to != to.forward_mps && left_s > 0.0
          ? towards(first.to, to.forward_mps, limits.max_acceleration_mps2 * left_s)
          : towards(from.forward_mps, first.to, first.rate * dt_s);
  return {forward_mps,
          towards(from.turn_radps, to.turn_radps, limits.max_turn_acceleration_radps2 * dt_s)};
}

DriveState driven(const DriveLimits& limits, const DriveState& state, const VelocityCommand& wanted,
                  double dt_s) {
  const VelocityCommand then = speedAfter(limits, state.speed, wanted, dt_s);
  const double way = 0.5 * (state.speed.forward_mps + then.forward_mps) * dt_s;
  const double turn = 0.5 * (state.speed.turn_radps + then.turn_radps) * dt_s;
  return {alongArc(state.pose, way, turn), then};
}

double stoppingDistance(const DriveLimits& limits, double speed_mps, double latency_s) {
  return speed_mps * latency_s + speed_mps * speed_mps / (2.0 * limits.max_braking_mps2);
}

double speedToStopWithin(const DriveLimits& limits, double way_m) {
  return std::sqrt(2.0 * limits.max_braking_mps2 * std::max(way_m, 0.0));
}

void addHeld(const DriveLimits& limits, const DriveState& now, const VelocityCommand& command,
             Trajectories& out) {
  out.commands.push_back(command);
  DriveState state = now;
  for (std::size_t i = 0; i < out.steps; ++i) {
    state = driven(limits, state, command, limits.period_s);
    out.poses.push_back(state.pose);
  }
}

double turnToFace(const DriveLimits& limits, const DriveState& now, const Vector2d& point,
                  const FacingParams& params) {
  const Vector2d to = point - now.pose.position;
  if (!to.allFinite() || to.norm() < 1e-3 || !std::isfinite(now.pose.yaw_rad)) return 0.0;
  const double angle = wrapped(std::atan2(to.y(), to.x()) - now.pose.yaw_rad);
  const bool turns = std::abs(now.speed.turn_radps) > 1e-3;
  if (std::abs(angle) < (turns ? kTurnEnds_rad : kTurnBegins_rad)) return 0.0;
  // What is left to turn after this period must be enough to brake in.
  const double left =
      std::max(std::abs(angle) - std::abs(now.speed.turn_radps) * limits.period_s, 0.0);
  const double most = std::min({limits.max_turn_radps, params.gain * std::abs(angle),
                                std::sqrt(2.0 * limits.max_turn_acceleration_radps2 * left)});
  return std::copysign(most, angle);
}

}  // namespace heel
