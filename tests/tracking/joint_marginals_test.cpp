// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/joint_marginals.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace heel {
namespace {

/// The truth: goes through all ways to say who is who in which no person is two.
std::vector<Evidence> enumerated(const std::vector<BodyWeights>& bodies) {
  constexpr int kNobody = kHypotheses;
  std::vector<Evidence> sums(bodies.size(), Evidence::Zero());
  std::vector<int> who(bodies.size(), 0);
  double total = 0.0;
  const std::function<void(std::size_t, double)> enumerate = [&](std::size_t i, double weight) {
    if (i == bodies.size()) {
      total += weight;
      for (std::size_t k = 0; k < who.size(); ++k) {
        if (who[k] != kNobody) sums[k][who[k]] += weight;
      }
      return;
    }
    for (int h = 0; h <= kNobody; ++h) {
      bool is_taken = false;
      for (std::size_t k = 0; k < i; ++k) {
        is_taken = is_taken || (h >= kTarget && h != kNobody && who[k] == h);
      }
      if (is_taken) continue;
      who[i] = h;
      enumerate(i + 1, weight * (h == kNobody ? bodies[i].nobody : bodies[i].weight[h]));
    }
  };
  enumerate(0, 1.0);
  for (Evidence& sum : sums) sum /= total;
  return sums;
}

TEST(JointMarginals, AreThoseOfAllWaysToSayWhoIsWho) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_weight(-6.0, 6.0);
  JointMarginals marginals;
  for (const int people : {0, 1, 3, kHypotheses - kTarget}) {
    for (const int count : {0, 1, 2, 4}) {
      std::vector<BodyWeights> bodies(static_cast<std::size_t>(count));
      for (BodyWeights& body : bodies) {
        for (int h = 0; h < kTarget + people; ++h) body.weight[h] = std::exp(log_weight(random));
        body.nobody = std::exp(log_weight(random));
      }
      const std::vector<Evidence> truth = enumerated(bodies);
      const std::vector<Evidence>& found = marginals.of(bodies);
      ASSERT_EQ(found.size(), truth.size());
      for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_TRUE(found[i].isApprox(truth[i], 1e-9)) << people << " people, body " << i;
      }
    }
  }
}

TEST(JointMarginals, OfAnyNumberOfBodiesNoWeightIsLost) {
  constexpr int kBodies = 2000;
  BodyWeights body;
  body.weight[kThing] = 0.1;
  body.weight[kStranger] = body.weight[kTarget] = 0.05;
  JointMarginals marginals;
  const auto& found = marginals.of(std::vector<BodyWeights>(kBodies, body));
  // None is the target: 0.15^n. One of them is: n 0.05 0.15^(n - 1).
  EXPECT_NEAR(found.front()[kTarget], 0.05 / (0.15 + 0.05 * kBodies), 1e-12);
  EXPECT_NEAR(found.back()[kTarget], found.front()[kTarget], 1e-12);
}

TEST(JointMarginals, OnlyTheRatiosOfABodysWeightsCount) {
  std::vector<BodyWeights> bodies(2);
  for (BodyWeights& body : bodies) body.weight.head<kTarget + 1>() = 1.0;
  JointMarginals marginals;
  const std::vector<Evidence> before = marginals.of(bodies);
  bodies[0].weight *= 1e-200;
  bodies[1].weight *= 1e200;
  const std::vector<Evidence>& after = marginals.of(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) EXPECT_TRUE(after[i].isApprox(before[i]));
  EXPECT_DOUBLE_EQ(after[0][kTarget], 0.25);
}

}  // namespace
}  // namespace heel
