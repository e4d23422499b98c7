// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_table.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace heel {
namespace {

/// The paper's formula s D_H(h) + (1 - s) D_V(v), with made-up D_H (a red and a blue peak) and D_V
/// (dark), scaled so that its greatest value is 255.
std::uint8_t paperScore(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  const int v = std::max({b, g, r});
  const int chroma = v - std::min({b, g, r});
  const double s = v == 0 ? 0.0 : static_cast<double>(chroma) / v;
  double h_deg = 0.0;
  if (chroma != 0) {
    if (v == r) {
      h_deg = 60.0 * (g - b) / chroma;
    } else if (v == g) {
      h_deg = 60.0 * (b - r) / chroma + 120.0;
    } else {
      h_deg = 60.0 * (r - g) / chroma + 240.0;
    }
    if (h_deg < 0.0) h_deg += 360.0;
  }
  const auto hue_bin = static_cast<int>(h_deg / 10.0);  // 36 bins
  const int value_bin = v / 8;                          // 32 bins
  const double d_h = hue_bin <= 1 || hue_bin == 35 ? 0.2 : hue_bin / 2 == 11 ? 0.15 : 0.005;
  const double d_v = value_bin < 6 ? 0.15 : 0.1 / 26.0;
  return static_cast<std::uint8_t>(std::floor(255.0 * (s * d_h + (1.0 - s) * d_v) / 0.2));
}

/// Calls f(b, g, r) for all 2^24 colours, until it returns false.
template <typename F>
void forEveryColor(const F& f) {
  for (int b = 0; b < 256; ++b) {
    for (int g = 0; g < 256; ++g) {
      for (int r = 0; r < 256; ++r) {
        if (!f(static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g),
               static_cast<std::uint8_t>(r))) {
          return;
        }
      }
    }
  }
}

TEST(ColorTable, AgreesWithTheFormulaOnEveryColorWithinTheQuantisation) {
  const ColorTable table(paperScore, 60);
  std::size_t passed = 0;
  forEveryColor([&](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const std::uint8_t truth =
        paperScore(ColorTable::middle(b), ColorTable::middle(g), ColorTable::middle(r));
    passed += truth > 60 ? 1 : 0;
    EXPECT_EQ(table(b, g, r), truth) << int{b} << ' ' << int{g} << ' ' << int{r};
    EXPECT_EQ(table.passes(b, g, r), truth > 60);
    return !testing::Test::HasFailure();
  });
  EXPECT_GT(passed, std::size_t{1} << 20);  // the formula has something to say
  EXPECT_LT(passed, std::size_t{15} << 20);
}

TEST(ColorTable, IsExactInTheDark) {
  const ColorTable table(paperScore);
  for (std::uint8_t b = 0; b < 32; ++b) {
    for (std::uint8_t g = 0; g < 32; ++g) {
      for (std::uint8_t r = 0; r < 32; ++r) ASSERT_EQ(table(b, g, r), paperScore(b, g, r));
    }
  }
}

TEST(ColorTable, LevelsAreOneValueWideThenTwoThenFour) {
  std::set<int> levels;
  for (int v = 0; v < 256; ++v) {
    const auto value = static_cast<std::uint8_t>(v);
    const int width = v < 32 ? 1 : v < 64 ? 2 : 4;
    const int first = v - v % width;
    EXPECT_EQ(ColorTable::cell(value, 0, 0),
              ColorTable::cell(static_cast<std::uint8_t>(first), 0, 0));
    EXPECT_EQ(ColorTable::middle(value), first + width / 2);
    levels.insert(static_cast<int>(ColorTable::cell(value, 0, 0)));
  }
  EXPECT_EQ(levels.size(), ColorTable::kLevels);
  EXPECT_EQ(*levels.rbegin(), ColorTable::kLevels - 1);
  EXPECT_EQ(ColorTable::cell(255, 255, 255), ColorTable::kCells - 1);
}

TEST(ColorTable, AsksForTheScoreOfEachCellOnce) {
  std::set<int> asked;
  std::size_t calls = 0;
  const ColorTable table([&](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    ++calls;
    if (g == 0 && r == 0) asked.insert(b);
    return std::uint8_t{1};
  });
  EXPECT_EQ(calls, ColorTable::kCells);
  EXPECT_EQ(asked.size(), ColorTable::kLevels);
}

TEST(ColorTable, AColorPassesWhenItsScoreIsAboveTheThreshold) {
  const ColorTable table([](std::uint8_t b, std::uint8_t, std::uint8_t) { return b; }, 20);
  EXPECT_FALSE(table.passes(20, 255, 255));
  EXPECT_TRUE(table.passes(21, 0, 0));
}

TEST(ColorTable, AnotherThresholdSharesTheScores) {
  const ColorTable table(paperScore, 60);
  const ColorTable strict = table.withThreshold(200);
  EXPECT_EQ(strict.data(), table.data());
  EXPECT_EQ(strict.threshold(), 200);
  EXPECT_EQ(table.threshold(), 60);
}

TEST(ColorTable, AnEmptyTablePassesNothing) {
  const ColorTable table;
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.data(), nullptr);
  EXPECT_EQ(table(1, 2, 3), 0);
  EXPECT_FALSE(table.withThreshold(0).passes(1, 2, 3));
  EXPECT_FALSE(ColorTable(paperScore).empty());
}

}  // namespace
}  // namespace heel
