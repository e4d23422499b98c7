// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/motion_model.hpp>

#include <cmath>

namespace heel {

void OdometryMotion::add(const FloorPose& increment) {
  motion_ = motion_ * increment;
  way_m_ += increment.position.norm();
  turned_rad_ += std::abs(wrapped(increment.yaw_rad));
}

void moveParticles(const OdometryMotion& motion, const MotionModelParams& params,
                   RandomNumbers& random, ParticleSet& particles) {
  const double way_root = std::sqrt(motion.way_m());
  const double along_m = params.distance_noise * way_root;
  const double across_m = params.side_noise * way_root;
  const double heading_rad = std::sqrt(params.turn_noise * params.turn_noise * motion.turned_rad() +
                                       params.drift_noise * params.drift_noise * motion.way_m());
  const FloorPose& step = motion.motion();
  // "Along" is where the motion leads, which is backwards for a robot that backs.
  const double length = step.position.norm();
  const Eigen::Vector2d along =
      length > 1e-9 ? Eigen::Vector2d(step.position / length) : Eigen::Vector2d::UnitX();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double ahead_m = length + along_m * random.normal();
    const double aside_m = across_m * random.normal();
    const double turn_rad = heading_rad * random.normal();
    const double x = along.x() * ahead_m - along.y() * aside_m;
    const double y = along.y() * ahead_m + along.x() * aside_m;
    const auto yaw = static_cast<double>(particles.yaw_rad[i]);
    const double c = std::cos(yaw + turn_rad / 2.0), s = std::sin(yaw + turn_rad / 2.0);
    particles.x_m[i] += static_cast<float>(c * x - s * y);
    particles.y_m[i] += static_cast<float>(s * x + c * y);
    particles.yaw_rad[i] = static_cast<float>(wrapped(yaw + step.yaw_rad + turn_rad));
  }
}

void shakeParticles(double place_m, double heading_rad, std::size_t first, RandomNumbers& random,
                    ParticleSet& particles) {
  for (std::size_t i = first; i < particles.size(); ++i) {
    particles.x_m[i] += static_cast<float>(place_m * random.normal());
    particles.y_m[i] += static_cast<float>(place_m * random.normal());
    particles.yaw_rad[i] = static_cast<float>(
        wrapped(static_cast<double>(particles.yaw_rad[i]) + heading_rad * random.normal()));
  }
}

}  // namespace heel
