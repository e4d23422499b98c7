// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/trajectory.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

void checkLimits(const DriveLimits& limits) {
  for (const double limit :
       {limits.radius_m, limits.max_speed_mps, limits.max_reverse_mps, limits.max_turn_radps,
        limits.max_acceleration_mps2, limits.max_turn_acceleration_radps2, limits.period_s}) {
    if (!(limit > 0.0) || !std::isfinite(limit)) {
      throw std::invalid_argument("a drive's limits must be positive");
    }
  }
}

VelocityCommand speedAfter(const DriveLimits& limits, const VelocityCommand& from,
                           const VelocityCommand& to, double dt_s) {
  const auto towards = [](double a, double b, double most) {
    return a + std::clamp(b - a, -most, most);
  };
  return {towards(from.forward_mps, to.forward_mps, limits.max_acceleration_mps2 * dt_s),
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
  return speed_mps * latency_s + speed_mps * speed_mps / (2.0 * limits.max_acceleration_mps2);
}

double speedToStopWithin(const DriveLimits& limits, double way_m) {
  return std::sqrt(2.0 * limits.max_acceleration_mps2 * std::max(way_m, 0.0));
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

double turnToFace(const DriveLimits& limits, const DriveState& now, const Eigen::Vector2d& point,
                  const FacingParams& params) {
  const Eigen::Vector2d to = point - now.pose.position;
  if (!to.allFinite() || to.norm() < 1e-3 || !std::isfinite(now.pose.yaw_rad)) return 0.0;
  const double angle = wrapped(std::atan2(to.y(), to.x()) - now.pose.yaw_rad);
  const bool turns = std::abs(now.speed.turn_radps) > 1e-3;
  if (std::abs(angle) < (turns ? params.still_rad : params.begin_rad)) return 0.0;
  // What is left to turn after this period must be enough to brake in.
  const double left =
      std::max(std::abs(angle) - std::abs(now.speed.turn_radps) * limits.period_s, 0.0);
  const double most = std::min({limits.max_turn_radps, params.gain * std::abs(angle),
                                std::sqrt(2.0 * limits.max_turn_acceleration_radps2 * left)});
  return std::copysign(most, angle);
}

}  // namespace heel
