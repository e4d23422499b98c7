// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/facing.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

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
