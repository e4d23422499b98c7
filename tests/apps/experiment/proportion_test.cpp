// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/proportion.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

// By hand: n = 10, k = 5, z = 1.96: middle (0.5 + 0.19208) / 1.38416 = 0.5, half
// 1.96 / 1.38416 * sqrt(0.025 + 0.009604) = 0.26340.
TEST(WilsonInterval, AgreesWithTheFormulaByHand) {
  const ShareInterval interval = wilsonInterval({5, 10});
  EXPECT_NEAR(interval.low, 0.2366, 1e-4);
  EXPECT_NEAR(interval.high, 0.7634, 1e-4);
}

// Of none in n, the upper end is z^2 / (n + z^2).
TEST(WilsonInterval, SaysHowLittleAFewTrialsWithoutErrorProve) {
  const ShareInterval interval = wilsonInterval({0, 20});
  EXPECT_EQ(interval.low, 0.0);
  EXPECT_NEAR(interval.high, 3.8415 / 23.8415, 1e-4);
}

TEST(WilsonInterval, IsTheMirrorImageForTheComplement) {
  const ShareInterval a = wilsonInterval({3, 17});
  const ShareInterval b = wilsonInterval({14, 17});
  EXPECT_NEAR(a.low, 1.0 - b.high, 1e-12);
  EXPECT_NEAR(a.high, 1.0 - b.low, 1e-12);
}

TEST(WilsonInterval, KnowsNothingWithoutTrials) {
  EXPECT_EQ(wilsonInterval({}).low, 0.0);
  EXPECT_EQ(wilsonInterval({}).high, 1.0);
  EXPECT_TRUE(std::isnan(Proportion().share()));
}

TEST(WilsonInterval, RefusesImpossibleCounts) {
  EXPECT_THROW(wilsonInterval({3, 2}), std::invalid_argument);
  EXPECT_THROW(wilsonInterval({-1, 2}), std::invalid_argument);
}

TEST(WilsonInterval, IsToldInWords) { EXPECT_EQ(withInterval({99, 100}), "99 of 100 (95-100 %)"); }

// The share of the mean of n alike trials spreads as p (1 - p) / n.
TEST(BootstrapInterval, AgreesWithTheNormalOneWhereThatHolds) {
  std::vector<PartOf> runs;
  for (int i = 0; i < 400; ++i) runs.push_back({i % 4 == 0 ? 10.0 : 0.0, 10.0});
  const ShareInterval interval = bootstrapInterval(runs);
  const double half = 1.96 * std::sqrt(0.25 * 0.75 / 400.0);
  EXPECT_NEAR(interval.low, 0.25 - half, 0.1 * half);
  EXPECT_NEAR(interval.high, 0.25 + half, 0.1 * half);
}

TEST(BootstrapInterval, IsThePointWhereAllAreAlike) {
  const ShareInterval interval = bootstrapInterval({{1.0, 4.0}, {2.0, 8.0}});
  EXPECT_DOUBLE_EQ(interval.low, 0.25);
  EXPECT_DOUBLE_EQ(interval.high, 0.25);
}

TEST(BootstrapInterval, KnowsNothingWithoutRuns) { EXPECT_EQ(bootstrapInterval({}).high, 1.0); }

}  // namespace
}  // namespace heel
