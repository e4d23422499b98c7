// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/stature.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

/// Points every 5 mm from 1.2 m up to a height.
StatureSample bodyUpTo(double height_m) {
  StatureSample sample;
  const int points = static_cast<int>((height_m - 1.2) / 0.005 + 0.5);
  for (int i = 0; i <= points; ++i) sample.add(1.2 + 0.005 * i);
  return sample;
}

TEST(StatureSample, LiesUnderTheHighestPoints) {
  EXPECT_NEAR(*bodyUpTo(1.7).height_m(), 1.69, 0.006);
}

TEST(StatureSample, OneWildPointHardlyMovesIt) {
  StatureSample sample = bodyUpTo(1.7);
  sample.add(2.4);
  EXPECT_NEAR(*sample.height_m(), 1.69, 0.011);
}

TEST(StatureSample, SaysNothingOfAHeadThatMayBeCutOff) {
  StatureSample sample = bodyUpTo(1.7);
  sample.add(0.8, true);
  EXPECT_TRUE(sample.height_m()) << "their legs may";
  sample.add(1.4, true);
  EXPECT_FALSE(sample.height_m());
}

TEST(StatureSample, NeedsMostOfWhatIsBehindToBeSeenAboveIt) {
  StatureSample sample = bodyUpTo(1.7);
  for (int i = 0; i < 60; ++i) sample.addBehind(1.71);
  for (int i = 0; i < 100; ++i) sample.addBehind(1.85);  // too far above
  for (int i = 0; i < 100; ++i) sample.addBehind(1.5);   // beside it
  EXPECT_TRUE(sample.height_m(90.0));
  EXPECT_FALSE(sample.height_m(91.0));
}

TEST(StatureSample, SaysNothingFromLegsOrAFewPoints) {
  StatureSample sample;
  for (int i = 0; i < 1000; ++i) sample.add(0.8);
  EXPECT_FALSE(sample.height_m());
  for (int i = 0; i < 20; ++i) sample.add(1.6);
  EXPECT_FALSE(sample.height_m());
}

TEST(Stature, IsTheMedianAndTheSpreadOfTheMiddleHalf) {
  const auto stature = statureFrom({1.70, 1.71, 1.72, 1.73, 9.0});
  ASSERT_TRUE(stature);
  EXPECT_DOUBLE_EQ(stature->height_m, 1.72);
  EXPECT_NEAR(stature->spread_m, (1.73 - 1.71) / 1.349, 1e-12);
  EXPECT_EQ(stature->frames, 5);
}

TEST(Stature, OfTooFewFramesIsUnknown) { EXPECT_FALSE(statureFrom({1.7, 1.7, 1.7, 1.7})); }

}  // namespace
}  // namespace heel
