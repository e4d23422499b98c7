// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_histogram.hpp>

#include <gtest/gtest.h>

#include <cstdint>

namespace heel {
namespace {

TEST(ColorHistogram, CountsAlikeWhatATableTreatsAlike) {
  ColorHistogram colors;
  colors.add(200, 100, 3);
  colors.add(203, 103, 3);  // the same cell: steps of four in the light
  colors.add(200, 100, 4);  // another: steps of one in the dark
  EXPECT_EQ(colors.total(), 3U);
  EXPECT_EQ(colors(201, 101, 3), 2U);
  EXPECT_EQ(colors(200, 100, 4), 1U);
  EXPECT_EQ(colors(0, 0, 0), 0U);
}

TEST(ColorHistogram, VisitsEachCellOnceByItsMiddleColour) {
  ColorHistogram colors;
  for (int v = 0; v < 256; ++v) {
    const auto value = static_cast<std::uint8_t>(v);
    colors.add(value, static_cast<std::uint8_t>(255 - v), value);
  }
  std::uint64_t sum = 0;
  colors.forEach([&](Bgr c, std::uint64_t count) {
    EXPECT_EQ(c.b, ColorTable::middle(c.b));
    EXPECT_EQ(colors(c.b, c.g, c.r), count);
    sum += count;
  });
  EXPECT_EQ(sum, 256U);
}

TEST(ColorHistogram, MergesCounts) {
  ColorHistogram a;
  ColorHistogram b;
  a.add({1, 2, 3}, 5);
  b.add({1, 2, 3}, 7);
  b.add({9, 9, 9}, 1);
  a.merge(b);
  EXPECT_EQ(a(1, 2, 3), 12U);
  EXPECT_EQ(a(9, 9, 9), 1U);
  EXPECT_EQ(a.total(), 13U);
}

}  // namespace
}  // namespace heel
