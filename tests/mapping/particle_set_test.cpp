// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/mapping/drawn_rooms.hpp"
#include <heel/mapping/motion_model.hpp>
#include <heel/mapping/particle_set.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

ParticleSet particlesAt(const FloorPose& pose, std::size_t count) {
  ParticleSet set;
  for (std::size_t i = 0; i < count; ++i) set.add(pose);
  set.setEqualWeights();
  return set;
}

TEST(ParticleSet, DrawsEachParticleAsOftenAsItsWeightSaysGiveOrTakeOne) {
  ParticleSet from;
  const float weights[] = {0.1F, 0.0F, 0.45F, 0.05F, 0.4F};
  for (int i = 0; i < 5; ++i) {
    from.add({{i, 0.0}, 0.0});
    from.weight.back() = weights[i];
  }
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    RandomNumbers random(seed);
    ParticleSet to;
    drawSystematic(from, 997, random, to);
    ASSERT_EQ(to.size(), 997U);
    int counts[5] = {};
    for (const float x : to.x_m) ++counts[static_cast<int>(x)];
    for (int i = 0; i < 5; ++i) {
      EXPECT_NEAR(counts[i], 997 * static_cast<double>(weights[i]), 1.001) << "seed " << seed;
    }
  }
}

TEST(ParticleSet, WeighsByDifferencesHoweverUnlikelyAllAre) {
  ParticleSet set = particlesAt({}, 3);
  const float log_likelihood[] = {-50000.0F, -50000.0F + std::log(2.0F), -60000.0F};
  set.weigh(log_likelihood, 1.0);
  EXPECT_NEAR(set.weight[0], 1.0 / 3.0, 2e-3);  // Floats of this size have steps of 1/256.
  EXPECT_NEAR(set.weight[1], 2.0 / 3.0, 2e-3);
  EXPECT_EQ(set.weight[2], 0.0F);
  EXPECT_NEAR(set.effectiveSize(), 9.0 / 5.0, 1e-2);
}

TEST(ParticleSet, LetsTheSceneDecideIfAllThatHadWeightIsImpossible) {
  ParticleSet set = particlesAt({}, 2);
  set.weight = {1.0F, 0.0F};
  const float log_likelihood[] = {-1000.0F, 0.0F};
  set.weigh(log_likelihood, 1.0);
  EXPECT_EQ(set.weight[0], 0.0F);
  EXPECT_EQ(set.weight[1], 1.0F);
}

TEST(KldParticles, IsFoxsFormula) {
  EXPECT_EQ(kldParticles(0, 0.05, 2.326), 1U);
  EXPECT_EQ(kldParticles(1, 0.05, 2.326), 1U);
  for (const std::size_t bins : {2U, 10U, 500U}) {
    const double k = static_cast<double>(bins) - 1.0;
    const double expected =
        k / 0.1 * std::pow(1.0 - 2.0 / (9.0 * k) + std::sqrt(2.0 / (9.0 * k)) * 2.326, 3.0);
    EXPECT_EQ(kldParticles(bins, 0.05, 2.326), static_cast<std::size_t>(std::ceil(expected)));
  }
  // The chi-square quantile that the formula stands for: 99 % of 10 degrees is 23.209.
  EXPECT_NEAR(static_cast<double>(kldParticles(11, 0.05, 2.326)), 23.209 / 0.1, 2.0);
}

TEST(PoseBins, CountsWhatIsFilledAndForgets) {
  PoseBins bins(0.5, 0.2, 100);
  EXPECT_EQ(bins.add(0.1F, 0.1F, 0.1F, 1.0F), 0U);
  EXPECT_EQ(bins.add(0.4F, 0.4F, 0.15F, 1.0F), 0U);
  EXPECT_EQ(bins.add(-0.1F, 0.1F, 0.1F, 5.0F), 1U);
  EXPECT_EQ(bins.add(0.1F, 0.1F, -0.1F, 1.0F), 2U);
  EXPECT_EQ(bins.count(), 3U);
  EXPECT_EQ(bins.heaviest(), 1U);
  bins.clear();
  EXPECT_EQ(bins.count(), 0U);
  EXPECT_EQ(bins.add(0.1F, 0.1F, -0.1F, 1.0F), 0U);
}

struct Spread {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
};

Spread spreadOf(const ParticleSet& set) {
  Spread s;
  const auto count = static_cast<double>(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Eigen::Vector3d v(set.x_m[i], set.y_m[i], set.yaw_rad[i]);
    s.mean += v / count;
    s.variance += v.cwiseProduct(v) / count;
  }
  s.variance -= s.mean.cwiseProduct(s.mean);
  return s;
}

TEST(MotionModel, SpreadsParticlesAsItsParametersSay) {
  const MotionModelParams params;
  ParticleSet set = particlesAt({}, 40000);
  OdometryMotion motion;
  motion.add({{0.5, 0.0}, 0.0});
  motion.add({{0.5, 0.0}, 0.4});
  EXPECT_DOUBLE_EQ(motion.way_m(), 1.0);
  EXPECT_DOUBLE_EQ(motion.turned_rad(), 0.4);
  RandomNumbers random(3);
  moveParticles(motion, params, random, set);
  const Spread s = spreadOf(set);
  const double yaw_variance =
      params.turn_noise * params.turn_noise * 0.4 + params.drift_noise * params.drift_noise;
  EXPECT_NEAR(s.mean.x(), 1.0, 0.005);
  EXPECT_NEAR(s.mean.y(), 0.0, 0.005);
  EXPECT_NEAR(s.mean.z(), 0.4, 0.005);
  EXPECT_NEAR(s.variance.x(), params.distance_noise * params.distance_noise, 6e-4);
  EXPECT_NEAR(s.variance.y(), params.side_noise * params.side_noise + yaw_variance / 4.0, 2e-4);
  EXPECT_NEAR(s.variance.z(), yaw_variance, 0.05 * yaw_variance);
}

TEST(MotionModel, DoesNotCareInHowManyStepsAWayIsTold) {
  const MotionModelParams params;
  ParticleSet one = particlesAt({}, 40000), many = one;
  RandomNumbers random(4);
  OdometryMotion motion;
  motion.add({{1.0, 0.0}, 0.0});
  moveParticles(motion, params, random, one);
  for (int i = 0; i < 10; ++i) {
    motion.clear();
    motion.add({{0.1, 0.0}, 0.0});
    moveParticles(motion, params, random, many);
  }
  const Spread a = spreadOf(one), b = spreadOf(many);
  EXPECT_NEAR(a.variance.x(), b.variance.x(), 0.05 * a.variance.x());
  EXPECT_NEAR(a.variance.z(), b.variance.z(), 0.05 * a.variance.z());
}

TEST(MotionModel, BacksAlongTheWayBack) {
  ParticleSet set = particlesAt({{1.0, 1.0}, test::kPi / 2.0}, 1);
  MotionModelParams exact{0.0, 0.0, 0.0, 0.0};
  OdometryMotion motion;
  motion.add({{-0.5, 0.0}, 0.0});
  RandomNumbers random(1);
  moveParticles(motion, exact, random, set);
  EXPECT_NEAR(set.x_m[0], 1.0, 1e-6);
  EXPECT_NEAR(set.y_m[0], 0.5, 1e-6);
}

}  // namespace
}  // namespace heel
