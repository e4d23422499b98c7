// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/kalman.hpp>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

const Eigen::Matrix2d kNoise = Eigen::Matrix2d::Identity() * 0.01;
constexpr double kForever = std::numeric_limits<double>::infinity();

double smallestEigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues().minCoeff();
}

MotionState somebody() {
  MotionState state = startMotion({1.0, -2.0}, kNoise, 1.0);
  state = update(predict(state, 0.2), {1.2, -2.1}, kNoise);
  return predict(state, 0.1);
}

TEST(Kalman, StartsAtThePlaceWithAnUnknownVelocity) {
  const MotionState state = startMotion({1.0, -2.0}, kNoise, 0.5);
  EXPECT_EQ(state.position_m(), Eigen::Vector2d(1.0, -2.0));
  EXPECT_EQ(state.velocity_mps(), Eigen::Vector2d::Zero());
  EXPECT_DOUBLE_EQ(state.covariance(0, 0), 0.01);
  EXPECT_DOUBLE_EQ(state.covariance(3, 3), 0.25);
}

TEST(Kalman, PredictMovesAlongTheVelocity) {
  MotionState state;
  state.mean << 1.0, 2.0, 0.5, -0.25;
  EXPECT_TRUE(
      predict(state, 2.0, {1.0, kForever}).mean.isApprox(Eigen::Vector4d(2.0, 1.5, 0.5, -0.25)));
}

TEST(Kalman, PredictAddsTheIntegratedNoise) {
  MotionState state;
  state.covariance.setZero();
  const Eigen::Matrix4d q = predict(state, 2.0, {3.0, kForever}).covariance;
  EXPECT_NEAR(q(0, 0), 3.0 * 8.0 / 3.0, 1e-12);
  EXPECT_NEAR(q(0, 2), 3.0 * 4.0 / 2.0, 1e-12);
  EXPECT_NEAR(q(2, 2), 3.0 * 2.0, 1e-12);
  EXPECT_EQ(q(0, 1), 0.0);
  EXPECT_EQ(q(0, 3), 0.0);
}

TEST(Kalman, PredictForgetsTheVelocity) {
  MotionState state;
  state.mean << 1.0, 0.0, 1.0, 0.0;
  // After a time constant 1/e of the velocity is left; in the end it has gone its time constant.
  EXPECT_NEAR(predict(state, 0.5, {1.0, 0.5}).mean(2), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(predict(state, 50.0, {1.0, 0.5}).mean(0), 1.5, 1e-12);
  // The velocity's noise settles at density * memory / 2.
  EXPECT_NEAR(predict(state, 50.0, {1.2, 0.5}).covariance(2, 2), 0.3, 1e-12);
}

TEST(Kalman, LongMemoryIsConstantVelocity) {
  const MotionState close = predict(somebody(), 0.7, {0.8, 1e9});
  const MotionState exact = predict(somebody(), 0.7, {0.8, kForever});
  EXPECT_TRUE(close.mean.isApprox(exact.mean, 1e-8));
  EXPECT_TRUE(close.covariance.isApprox(exact.covariance, 1e-8));
}

TEST(Kalman, NoiseIsSmoothWhereItsSeriesEnds) {
  MotionState sure;
  sure.covariance.setZero();
  const double below = predict(sure, 0.01 * (1.0 - 1e-12), {1.0, 1.0}).covariance(0, 0);
  const double above = predict(sure, 0.01 * (1.0 + 1e-12), {1.0, 1.0}).covariance(0, 0);
  EXPECT_NEAR(above / below, 1.0, 1e-8);
}

TEST(Kalman, PredictTwiceIsPredictOnceOverTheSum) {
  for (const double memory_s : {0.1, 1.0, 10.0, kForever}) {
    for (const double a : {0.0, 0.033, 0.5, 2.0}) {
      for (const double b : {0.001, 0.2, 1.5}) {
        const MotionParams motion{0.8, memory_s};
        const MotionState twice = predict(predict(somebody(), a, motion), b, motion);
        const MotionState once = predict(somebody(), a + b, motion);
        EXPECT_TRUE(twice.mean.isApprox(once.mean, 1e-12));
        EXPECT_TRUE(twice.covariance.isApprox(once.covariance, 1e-10));
      }
    }
  }
}

TEST(Kalman, PredictRejectsABackwardOrUnknownStep) {
  EXPECT_THROW(predict({}, -0.1), std::invalid_argument);
  EXPECT_THROW(predict({}, std::nan("")), std::invalid_argument);
}

TEST(Kalman, CovarianceStaysSymmetricAndPositive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(0.0, 0.5);
  std::normal_distribution<double> place(0.0, 3.0);
  MotionState state = startMotion({0.0, 0.0}, kNoise, 1.0);
  for (int i = 0; i < 10000; ++i) {
    // Noise over six orders of magnitude, in turns.
    const Eigen::Matrix2d noise = Eigen::Matrix2d::Identity() * std::pow(10.0, -(i % 7));
    state = update(predict(state, step(random)), {place(random), place(random)}, noise);
    ASSERT_EQ(state.covariance, state.covariance.transpose());
    ASSERT_GT(smallestEigenvalue(state.covariance), 0.0) << "step " << i;
  }
}

TEST(Kalman, UpdateNeverEnlargesTheCovariance) {
  MotionState state = somebody();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix2d noise = Eigen::Matrix2d::Identity() * std::pow(10.0, 2 - i % 7);
    const MotionState next = update(state, {5.0 - i, 1.0 * i}, noise);
    EXPECT_GE(smallestEigenvalue(state.covariance - next.covariance), -1e-12);
    state = predict(next, 0.2);
  }
}

TEST(Kalman, UpdateWeighsByTheCovariances) {
  MotionState state;  // Unit covariance, at the origin.
  const MotionState next = update(state, {1.0, 2.0}, Eigen::Matrix2d::Identity());
  EXPECT_TRUE(next.position_m().isApprox(Eigen::Vector2d(0.5, 1.0)));
  EXPECT_NEAR(next.covariance(0, 0), 0.5, 1e-12);
  EXPECT_NEAR(next.covariance(2, 2), 1.0, 1e-12);
}

TEST(Kalman, InnovationsHaveTheirExpectedSizeOnSimulatedPeople) {
  const MotionParams motion{0.7, kForever};
  const double dt_s = 0.2;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  // The noise's square root, per axis, from the closed form of its 2x2 covariance.
  const double q11 = motion.acceleration_density * dt_s * dt_s * dt_s / 3.0;
  const double q12 = motion.acceleration_density * dt_s * dt_s / 2.0;
  const double q22 = motion.acceleration_density * dt_s;
  double sum = 0.0;
  int count = 0;
  for (int person = 0; person < 500; ++person) {
    Eigen::Vector4d truth(0.0, 0.0, normal(random), normal(random));
    MotionState state = startMotion({0.1 * normal(random), 0.1 * normal(random)}, kNoise, 1.0);
    for (int k = 0; k < 20; ++k) {
      for (int axis = 0; axis < 2; ++axis) {
        const double e1 = normal(random), e2 = normal(random);
        truth(axis) += dt_s * truth(axis + 2) + std::sqrt(q11) * e1;
        truth(axis + 2) += q12 / std::sqrt(q11) * e1 + std::sqrt(q22 - q12 * q12 / q11) * e2;
      }
      state = predict(state, dt_s, motion);
      const Eigen::Vector2d z(truth(0) + 0.1 * normal(random), truth(1) + 0.1 * normal(random));
      sum += squaredMahalanobis(innovation(state, z, kNoise));
      ++count;
      state = update(state, z, kNoise);
    }
  }
  // Mean 2, standard deviation of the mean 2 / sqrt(10000) = 0.02.
  EXPECT_NEAR(sum / count, 2.0, 0.08);
}

TEST(Kalman, MahalanobisAndLikelihoodMatchTheirFormulas) {
  Innovation seen;
  seen.residual_m = {2.0, 3.0};
  seen.covariance_m2 << 4.0, 0.0, 0.0, 9.0;
  EXPECT_NEAR(squaredMahalanobis(seen), 2.0, 1e-12);
  EXPECT_NEAR(std::exp(logLikelihood(seen)), std::exp(-1.0) / (2.0 * std::acos(-1.0) * 6.0), 1e-12);
}

TEST(Kalman, ChiSquareQuantileMatchesTheTables) {
  EXPECT_NEAR(chiSquare2Quantile(0.95), 5.991465, 1e-6);
  EXPECT_NEAR(chiSquare2Quantile(0.99), 9.210340, 1e-6);
  EXPECT_THROW(chiSquare2Quantile(1.0), std::invalid_argument);
  EXPECT_THROW(chiSquare2Quantile(0.0), std::invalid_argument);
}

}  // namespace
}  // namespace heel
