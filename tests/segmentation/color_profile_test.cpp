// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/color_profile.hpp"

#include "tests/segmentation/painted_person.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

using test::paint;

ColorSample sampleOf(const ColorHistogram& colors) {
  ColorSample sample;
  colors.forEach([&](Bgr c, std::uint64_t count) {
    for (; count > 0; --count) sample.add(c.b, c.g, c.r);
  });
  return sample;
}

double affinity(const ColorHistogram& a, const ColorHistogram& b) {
  return sampleOf(a).affinity(ColorProfile(b));
}

TEST(ColorProfile, IsOneWithItself) {
  const ColorHistogram red = paint(test::kRed, 500);
  EXPECT_NEAR(affinity(red, red), 1.0, 1e-5);
}

TEST(ColorProfile, DoesNotDependOnTheNumberOfPixels) {
  EXPECT_GT(affinity(paint(test::kRed, 300, 6.0, 5), paint(test::kRed, 9000)), 0.95);
}

TEST(ColorProfile, OfOtherColorsSharesNothing) {
  EXPECT_LT(affinity(paint(test::kRed, 500), paint(test::kFloor, 500)), 0.05);
}

TEST(ColorProfile, TellsProportionsApartWhereEveryColorIsTheTargets) {
  ColorHistogram checks = paint(test::kRed, 500);
  checks.merge(paint(test::kBlack, 500));
  EXPECT_NEAR(affinity(paint(test::kRed, 500), checks), std::sqrt(0.5), 0.03);
}

TEST(ColorProfile, ForgivesALittleLessLight) {
  EXPECT_GT(affinity(paint({34, 26, 153}, 500), paint({40, 30, 180}, 500)), 0.7);
}

TEST(ColorProfile, OfNothingIsLikeNothing) {
  const ColorHistogram red = paint(test::kRed, 50);
  EXPECT_TRUE(ColorProfile(ColorHistogram()).empty());
  EXPECT_EQ(affinity(red, ColorHistogram()), 0.0);
  EXPECT_EQ(affinity(ColorHistogram(), red), 0.0);
}

TEST(ColorSample, StartsAnewWhenCleared) {
  const ColorProfile red(paint(test::kRed, 500));
  ColorSample sample = sampleOf(paint(test::kFloor, 500));
  EXPECT_LT(sample.affinity(red), 0.05);
  sample.clear();
  paint(test::kRed, 500).forEach([&](Bgr c, std::uint64_t) { sample.add(c.b, c.g, c.r); });
  EXPECT_GT(sample.affinity(red), 0.9);
}

}  // namespace
}  // namespace heel
