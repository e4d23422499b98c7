// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/painted_person.hpp"
#include <heel/segmentation/color_histogram.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

using test::kNavy;
using test::kRed;
using test::kWhite;
using test::paint;

TEST(ColorClusters, FindTheStripesOfAJumper) {
  ColorHistogram jumper = paint(kRed, 3000);
  jumper.merge(paint(kWhite, 2000));
  jumper.merge(paint(kNavy, 1000, 2.0));
  const auto found = clusterColors(jumper, 3).clusters;
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].total(), 3000U);
  EXPECT_EQ(found[1].total(), 2000U);
  EXPECT_EQ(found[2].total(), 1000U);
  EXPECT_TRUE(test::sameColors(found[1], paint(kWhite, 2000)));
}

TEST(ColorClusters, TakeAsManyAsTheDataShow) {
  ColorHistogram jumper = paint(kRed, 3000);
  EXPECT_EQ(clusterColorsFromData(jumper, 4, 0.5).clusters.size(), 1U);
  jumper.merge(paint(kWhite, 2500));
  EXPECT_EQ(clusterColorsFromData(jumper, 4, 0.5).clusters.size(), 2U);
}

TEST(ColorClusters, AreNotMoreThanThereAreColours) {
  ColorHistogram two;
  two.add({1, 2, 3}, 10);
  two.add({200, 2, 3}, 10);
  const auto found = clusterColors(two, 5);
  EXPECT_EQ(found.clusters.size(), 2U);
  EXPECT_DOUBLE_EQ(found.spread, 0.0);
}

TEST(ColorClusters, RefuseNothing) {
  EXPECT_THROW(clusterColors(ColorHistogram(), 1), std::invalid_argument);
  EXPECT_THROW(clusterColors(paint(kRed, 1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace heel
