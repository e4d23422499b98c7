// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/kalman.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

/// (1 - e^-x) / x: the mean velocity over a step, as a share of that at its start.
double meanShare(double x) { return x > 0.0 ? -std::expm1(-x) / x : 1.0; }

/// (x - 2 (1 - e^-x) + (1 - e^-2x) / 2) / x^3, which is 1/3 at x = 0. The formula loses
/// all its digits for small x, where the series has them.
double positionNoiseShare(double x) {
  if (x < 0.01) {
    return 1.0 / 3.0 - x * (1.0 / 4.0 - x * (7.0 / 60.0 - x * (1.0 / 24.0 - x * 31.0 / 2520.0)));
  }
  return (x + 2.0 * std::expm1(-x) - 0.5 * std::expm1(-2.0 * x)) / (x * x * x);
}

}  // namespace

MotionState startMotion(const Eigen::Vector2d& position_m, const Eigen::Matrix2d& position_noise_m2,
                        double speed_sigma_mps) {
  MotionState state;
  state.mean << position_m, 0.0, 0.0;
  state.covariance.setZero();
  state.covariance.topLeftCorner<2, 2>() = position_noise_m2;
  state.covariance.bottomRightCorner<2, 2>().diagonal().setConstant(speed_sigma_mps *
                                                                    speed_sigma_mps);
  return state;
}

MotionState predict(const MotionState& state, double dt_s, const MotionParams& params) {
  if (!std::isfinite(dt_s) || dt_s < 0.0) {
    throw std::invalid_argument("predict: the time step must be finite and not negative");
  }
  const double x = dt_s / params.velocity_memory_s;
  const double mean_share = meanShare(x);
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F.topRightCorner<2, 2>().diagonal().setConstant(dt_s * mean_share);
  F.bottomRightCorner<2, 2>().diagonal().setConstant(std::exp(-x));
  MotionState next;
  next.mean = F * state.mean;
  next.covariance = F * state.covariance * F.transpose();
  const double q = params.acceleration_density;
  const double q_xx = q * dt_s * dt_s * dt_s * positionNoiseShare(x);
  const double q_xv = q * dt_s * dt_s * mean_share * mean_share / 2.0;
  const double q_vv = q * dt_s * meanShare(2.0 * x);
  next.covariance.topLeftCorner<2, 2>().diagonal().array() += q_xx;
  next.covariance.topRightCorner<2, 2>().diagonal().array() += q_xv;
  next.covariance.bottomLeftCorner<2, 2>().diagonal().array() += q_xv;
  next.covariance.bottomRightCorner<2, 2>().diagonal().array() += q_vv;
  next.covariance = 0.5 * (next.covariance + next.covariance.transpose()).eval();
  return next;
}

Innovation innovation(const MotionState& state, const Eigen::Vector2d& measured_m,
                      const Eigen::Matrix2d& noise_m2) {
  return {measured_m - state.mean.head<2>(), state.covariance.topLeftCorner<2, 2>() + noise_m2};
}

MotionState update(const MotionState& state, const Eigen::Vector2d& measured_m,
                   const Eigen::Matrix2d& noise_m2) {
  const Innovation seen = innovation(state, measured_m, noise_m2);
  const Eigen::Matrix<double, 4, 2> gain =
      state.covariance.leftCols<2>() * seen.covariance_m2.inverse();
  Eigen::Matrix4d keep = Eigen::Matrix4d::Identity();
  keep.leftCols<2>() -= gain;
  MotionState next;
  next.mean = state.mean + gain * seen.residual_m;
  next.covariance = keep * state.covariance * keep.transpose() + gain * noise_m2 * gain.transpose();
  next.covariance = 0.5 * (next.covariance + next.covariance.transpose()).eval();
  return next;
}

double squaredMahalanobis(const Innovation& innovation) {
  return innovation.residual_m.dot(innovation.covariance_m2.llt().solve(innovation.residual_m));
}

double logLikelihood(const Innovation& innovation) {
  return -0.5 *
             (squaredMahalanobis(innovation) + std::log(innovation.covariance_m2.determinant())) -
         std::log(2.0 * M_PI);
}

double chiSquare2Quantile(double probability) {
  if (!(probability > 0.0 && probability < 1.0)) {
    throw std::invalid_argument("chiSquare2Quantile: the probability must be between 0 and 1");
  }
  return -2.0 * std::log1p(-probability);
}

}  // namespace heel
