// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Kalman filter of a person walking on the floor, as pure functions.
#pragma once

#include <Eigen/Core>

namespace heel {

/// Where a person is on the floor and how they move, as a Gaussian over (x, y, vx, vy) [m, m/s].
struct MotionState {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();

  Eigen::Vector2d position_m() const { return mean.head<2>(); }
  Eigen::Vector2d velocity_mps() const { return mean.tail<2>(); }
};

/// How people walk: they hold their velocity, forget it over time, and change it at random.
struct MotionParams {
  /// Power spectral density of the white acceleration, per axis [m^2/s^3]: in a second the
  /// velocity's standard deviation grows by about its square root.
  double acceleration_density = 0.8;
  /// Time in which a velocity is expected to fall to 1/e, as people stop sooner or later.
  /// Infinity: the constant-velocity model.
  double velocity_memory_s = 1.0;
};

/// What a measured place says beside the predicted one.
struct Innovation {
  Eigen::Vector2d residual_m = Eigen::Vector2d::Zero();         ///< Measured minus predicted.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  ///< Of the residual.
};

/// A state for a person first seen at `position_m`, whose velocity is zero give or take
/// `speed_sigma_mps` on each axis.
MotionState startMotion(const Eigen::Vector2d& position_m, const Eigen::Matrix2d& position_noise_m2,
                        double speed_sigma_mps);

/// Moves the state on by `dt_s`: dv = -v / memory dt + white acceleration, dx = v dt, integrated
/// exactly, noise too, so that predict(a) then predict(b) is predict(a + b).
/// @throws std::invalid_argument  if `dt_s` is negative or not finite.
MotionState predict(const MotionState& state, double dt_s, const MotionParams& params = {});

/// The residual of a place measured with covariance `noise_m2`, and its covariance.
Innovation innovation(const MotionState& state, const Eigen::Vector2d& measured_m,
                      const Eigen::Matrix2d& noise_m2);

/// Takes a measured place in. The covariance (Joseph's form) stays symmetric and positive, and
/// never grows.
MotionState update(const MotionState& state, const Eigen::Vector2d& measured_m,
                   const Eigen::Matrix2d& noise_m2);

/// Squared Mahalanobis distance; chi-square with 2 degrees of freedom when the model holds.
double squaredMahalanobis(const Innovation& innovation);

/// Natural logarithm of the residual's Gaussian density [1/m^2].
double logLikelihood(const Innovation& innovation);

/// The value that a chi-square variable with 2 degrees of freedom stays under with probability
/// `probability`: -2 ln(1 - p), exact.
/// @throws std::invalid_argument  unless 0 < probability < 1.
double chiSquare2Quantile(double probability);

}  // namespace heel
