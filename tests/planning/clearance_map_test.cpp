// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/drawn_map.hpp"
#include <heel/planning/clearance_map.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using test::Box;
using test::DrawnMap;

TEST(ClearanceMap, TellsTheDistanceToSquares) {
  const DrawnMap map{{4, 4}, 0.1, {{{2, 2}, {2.1, 2.1}}}};
  const ClearanceMap clearance(map.grid(), 1.0);
  EXPECT_NEAR(clearance.clearance({1.5, 2.05}), 0.5, 1e-9);
  EXPECT_NEAR(clearance.clearance({2.1 + 0.3, 2.1 + 0.4}), 0.5, 1e-9);
  EXPECT_EQ(clearance.clearance({2.05, 2.05}), 0.0);
  EXPECT_NEAR(clearance.clearance({1.0, 1.0}), 1.0, 1e-9) << "no further than the reach";
  EXPECT_NEAR(clearance.clearance({0.2, 1.0}), 0.2, 1e-9) << "the border";
  EXPECT_EQ(clearance.clearance({-0.2, 1.0}), 0.0);
}

TEST(ClearanceMap, AgreesWithBruteForceOnRandomMaps) {
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i) {
    const DrawnMap map = test::randomMap(random, 15, 4.0);
    const ClearanceMap clearance(map.grid(), 0.5);
    for (int cell = 0; cell < clearance.width() * clearance.height(); ++cell) {
      const Eigen::Vector2d p = clearance.centerOf(cell);
      const double truth = std::min(0.5, test::clearanceOf(map, p, p));
      EXPECT_NEAR(clearance.clearanceInCells(cell) * 0.05, truth, 1e-5);
      EXPECT_NEAR(clearance.clearance(p), truth, 1e-9);
    }
  }
}

TEST(ClearanceMap, KnowsExactlyWhatADiscSweeps) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.2, 4.2), radius(0.01, 0.5);
  for (int i = 0; i < 20; ++i) {
    const DrawnMap map = test::randomMap(random, 4, 4.0);
    const ClearanceMap clearance(map.grid(), 0.5);
    for (int k = 0; k < 500; ++k) {
      const Eigen::Vector2d a(place(random), place(random));
      Eigen::Vector2d b(place(random), place(random));
      if (k % 5 == 0) b.y() = a.y();
      if (k % 5 == 1) b.x() = a.x();
      if (k % 5 == 2) b = a;
      const double r = radius(random), truth = test::clearanceOf(map, a, b);
      if (std::abs(truth - r) < 1e-9) continue;
      EXPECT_EQ(clearance.isClear(a, b, r), truth > r) << a.transpose() << " to " << b.transpose();
    }
  }
}

TEST(ClearanceMap, WithALayerIsAsIfTheLayerWereInTheMap) {
  std::mt19937 random(5);
  const DrawnMap empty{{4, 4}, 0.05, {}};
  ClearanceMap layered(empty.grid(), 0.6);
  for (int i = 0; i < 10; ++i) {
    const OccupancyGrid cells = test::randomMap(random, 5, 4.0).grid();
    layered.setLayer({}, &cells);
    const ClearanceMap truth(cells, 0.6);
    for (int cell = 0; cell < truth.width() * truth.height(); ++cell) {
      ASSERT_EQ(layered.clearanceInCells(cell), truth.clearanceInCells(cell));
    }
    EXPECT_TRUE(layered.setLayer({}, &cells).empty()) << "the same again changes nothing";
  }
  layered.setLayer({});
  EXPECT_TRUE(layered.isClear({1, 1}, {3, 3}, 0.5));
}

TEST(ClearanceMap, BlocksTheCellsThatADiscCovers) {
  ClearanceMap map(DrawnMap{{2, 2}, 0.05, {}}.grid(), 0.5);
  map.setLayer({{{1.0, 1.0}, 0.2}, {{50.0, 50.0}, 0.2}});
  for (int cell = 0; cell < 40 * 40; ++cell) {
    const Eigen::Vector2d low = map.centerOf(cell).array() - 0.025;
    const Box square{low, low.array() + 0.05};
    EXPECT_EQ(map.isBlocked(cell), test::distanceTo(square, Eigen::Vector2d(1, 1)) < 0.2 - 1e-12);
  }
}

TEST(ClearanceMap, TakesTheUnknownAsBlockedUnlessToldOtherwise) {
  const OccupancyGrid map({0, 0}, 0.1, 20, 20, Occupancy::kUnknown);
  EXPECT_FALSE(ClearanceMap(map, 0.5).isClear({1, 1}, {1, 1}, 0.2));
  EXPECT_TRUE(ClearanceMap(map, 0.5, true).isClear({1, 1}, {1, 1}, 0.2));
}

TEST(ClearanceMap, RefusesWhatIsNone) {
  EXPECT_THROW(ClearanceMap(OccupancyGrid(), 0.5), std::invalid_argument);
  const OccupancyGrid map({0, 0}, 0.1, 5, 5);
  EXPECT_THROW(ClearanceMap(map, 0.0), std::invalid_argument);
  ClearanceMap clearance(map, 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(clearance.setLayer({{{nan, 0}, 0.1}}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
