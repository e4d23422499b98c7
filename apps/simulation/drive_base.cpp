// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/drive_base.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

DriveBase::DriveBase(const RobotParams& params)
    : params_(params), pose_{params.start, params.start_yaw_rad} {}

void DriveBase::accelerate(double dt_s, const VelocityCommand& command) {
  const DriveLimits& p = params_.drive;
  const VelocityCommand asked{std::clamp(command.forward_mps, -p.max_speed_mps, p.max_speed_mps),
                              std::clamp(command.turn_radps, -p.max_turn_radps, p.max_turn_radps)};
  speed_ = speedAfter(p, speed_, asked, dt_s);
}

FloorPose DriveBase::ahead(double dt_s) const {
  return alongArc(pose_, speed_.forward_mps * dt_s, speed_.turn_radps * dt_s);
}

void DriveBase::stop(bool may_turn) { speed_ = {0.0, may_turn ? speed_.turn_radps : 0.0}; }

void DriveBase::go(double dt_s) { pose_ = ahead(dt_s); }

WheelOdometry::WheelOdometry(const OdometryParams& params, std::uint64_t seed)
    : params_(params), random_(seed) {}

void WheelOdometry::add(double distance_m, double turn_rad) {
  const double way = std::sqrt(std::abs(distance_m)), turn = std::sqrt(std::abs(turn_rad));
  const double distance_error = params_.distance_noise * way * random_.gaussian();
  const double turn_error = params_.turn_noise * turn * random_.gaussian() +
                            params_.drift_noise * way * random_.gaussian();
  const double bias_m = params_.distance_bias * distance_m;
  const double bias_rad = params_.turn_bias * turn_rad + params_.drift_bias * std::abs(distance_m);
  pose_ = alongArc(pose_, distance_m + distance_error + bias_m, turn_rad + turn_error + bias_rad);
}

}  // namespace heel
