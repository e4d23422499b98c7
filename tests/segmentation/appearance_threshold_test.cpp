// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_threshold.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

std::vector<Bgr> randomPixels(int count, int darkest, int lightest, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> channel(darkest, lightest);
  std::vector<Bgr> pixels;
  for (int i = 0; i < count; ++i) {
    const auto next = [&] { return static_cast<std::uint8_t>(channel(generator)); };
    const std::uint8_t b = next();
    const std::uint8_t g = next();
    pixels.push_back({b, g, next()});
  }
  return pixels;
}

ColorHistogram histogramOf(const std::vector<Bgr>& pixels) {
  ColorHistogram colors;
  for (const Bgr c : pixels) colors.add(c.b, c.g, c.r);
  return colors;
}

TEST(AppearanceThreshold, CountsTheErrorsThatBruteForceCounts) {
  const auto person = randomPixels(3000, 0, 160, 1);
  const auto room = randomPixels(5000, 60, 255, 2);
  const ColorTable table([](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return static_cast<std::uint8_t>(255 - (b + 2 * g + r) / 4);
  });
  const ErrorCurve curve = countColorErrors(table, histogramOf(person), histogramOf(room));
  for (int threshold = 0; threshold < 256; ++threshold) {
    const auto filter = table.withThreshold(static_cast<std::uint8_t>(threshold));
    std::uint64_t false_positives = 0;
    std::uint64_t false_negatives = 0;
    for (const Bgr c : room) false_positives += filter.passes(c.b, c.g, c.r) ? 1U : 0U;
    for (const Bgr c : person) false_negatives += filter.passes(c.b, c.g, c.r) ? 0U : 1U;
    const ColorErrors& errors = curve[static_cast<std::size_t>(threshold)];
    EXPECT_EQ(errors.false_positives, false_positives);
    EXPECT_EQ(errors.false_negatives, false_negatives);
    EXPECT_DOUBLE_EQ(errors.false_positive_share, static_cast<double>(false_positives) / 5000.0);
    EXPECT_DOUBLE_EQ(errors.false_negative_share, static_cast<double>(false_negatives) / 3000.0);
  }
}

TEST(AppearanceThreshold, OfNothingHasNoErrors) {
  const ErrorCurve curve = countColorErrors(ColorTable(), ColorHistogram(), ColorHistogram());
  EXPECT_EQ(curve[0].false_positive_share, 0.0);
  EXPECT_EQ(curve[255].false_negative_share, 0.0);
}

/// False negatives grow by steps at 50, 100 and 150; false positives fall at 80 and 120.
ErrorCurve drawnCurve() {
  ErrorCurve curve;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve[i].false_negative_share = i < 50 ? 0.0 : i < 100 ? 0.1 : i < 150 ? 0.3 : 1.0;
    curve[i].false_positive_share = i < 80 ? 0.6 : i < 120 ? 0.2 : 0.1;
  }
  return curve;
}

TEST(AppearanceThreshold, OfFewestErrorsIsTheLowestOfTheBest) {
  EXPECT_EQ(chooseThreshold(drawnCurve()), 80);  // .1 + .2
}

TEST(AppearanceThreshold, MovesUpAsFalsePositivesWeighMore) {
  ThresholdParams params;
  params.false_positive_weight = 3.0;  // .3 + .3 at 120 against .1 + .6 at 80
  EXPECT_EQ(chooseThreshold(drawnCurve(), params), 120);
  params.false_positive_weight = 0.0;
  EXPECT_EQ(chooseThreshold(drawnCurve(), params), 0);
}

TEST(AppearanceThreshold, MostSelectiveIsTheHighestWithinTheLimit) {
  ThresholdParams params;
  params.rule = ThresholdRule::kMostSelective;
  params.max_false_negative_share = 0.1;
  EXPECT_EQ(chooseThreshold(drawnCurve(), params), 99);
  params.max_false_negative_share = 0.3;
  EXPECT_EQ(chooseThreshold(drawnCurve(), params), 149);
  params.max_false_negative_share = 1.0;
  EXPECT_EQ(chooseThreshold(drawnCurve(), params), 254);
}

TEST(AppearanceThreshold, RefusesParametersOutOfRange) {
  ThresholdParams params;
  params.false_positive_weight = -1.0;
  EXPECT_THROW(chooseThreshold(drawnCurve(), params), std::invalid_argument);
  params = {};
  params.max_false_negative_share = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(chooseThreshold(drawnCurve(), params), std::invalid_argument);
}

}  // namespace
}  // namespace heel
