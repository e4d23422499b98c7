// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where a robot may be after its wheels say that it has moved.
#pragma once

#include <heel/mapping/particle_set.hpp>

namespace heel {

/// Errors of the odometry as standard deviations that grow with the root of the way, so that it
/// does not matter in how many increments a way is told. The defaults are what a SLAM program's
/// corrections of a real differential drive's log amount to: too narrow loses the robot, too wide
/// costs particles.
struct MotionModelParams {
  double distance_noise = 0.1;  ///< Error of the distance, per root of a metre gone [m].
  double side_noise = 0.03;     ///< Error to the side, per root of a metre gone [m].
  double turn_noise = 0.12;     ///< Error of the heading, per root of a radian turned [rad].
  double drift_noise = 0.06;    ///< Error of the heading, per root of a metre gone [rad].
};

/// A motion put together from increments of the odometry.
class OdometryMotion {
 public:
  /// @param increment  The new pose in the frame of the one before.
  void add(const FloorPose& increment);
  void clear() { *this = {}; }

  const FloorPose& motion() const { return motion_; }
  double way_m() const { return way_m_; }            ///< Sum of all ways, however they turned.
  double turned_rad() const { return turned_rad_; }  ///< Sum of all turns, left and right.

 private:
  FloorPose motion_;
  double way_m_ = 0.0;
  double turned_rad_ = 0.0;
};

/// Moves every particle by the motion with an error of its own. Half of the heading's error comes
/// before the way and half after it, as if it had grown along the way.
void moveParticles(const OdometryMotion& motion, const MotionModelParams& params,
                   RandomNumbers& random, ParticleSet& particles);

/// Shakes every particle from `first` on by normal errors of these standard deviations.
void shakeParticles(double place_m, double heading_rad, std::size_t first, RandomNumbers& random,
                    ParticleSet& particles);

}  // namespace heel
