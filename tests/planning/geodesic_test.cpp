// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/drawn_map.hpp"
#include "tests/support/allocation_count.hpp"
#include <heel/planning/geodesic.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using test::DrawnMap;

TEST(GeodesicField, IsTheDistanceWhereNothingIsInTheWay) {
  const DrawnMap map{{5, 5}, 0.1, {}};
  GeodesicField field(map.grid(), 0.2);
  ASSERT_TRUE(field.measureFrom({2.55, 2.55}));
  EXPECT_NEAR(field.distance({2.55, 4.55}), 2.0, 1e-4);
  EXPECT_NEAR(field.distance({3.55, 3.55}), std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(field.distance({4.55, 3.05}), std::hypot(2.0, 0.5), 0.028 * 2.1);
  EXPECT_FALSE(std::isfinite(field.distance({0.05, 2.5}))) << "too near to the border";
  EXPECT_FALSE(std::isfinite(field.distance({-3.0, 2.5})));
}

TEST(GeodesicField, IsTheShortestWayOnRandomMaps) {
  std::mt19937 random(2);
  int compared = 0;
  for (int i = 0; i < 8; ++i) {
    const DrawnMap map = test::randomMap(random, 12, 6.0);
    GeodesicField field(map.grid(), 0.3);
    const Eigen::Vector2d from = test::randomPlace(random, map, 0.3);
    ASSERT_TRUE(field.measureFrom(from));
    const Eigen::Vector2d to = test::randomPlace(random, map, 0.36);
    const double truth = test::shortestWay(map, 0.3, from, to);
    if (!std::isfinite(field.distance(to))) continue;
    EXPECT_GT(field.distance(to), truth - 0.08);
    EXPECT_LT(field.distance(to), 1.04 * test::shortestWay(map, 0.32, from, to) + 0.08);
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

TEST(GeodesicField, ChangesWithWhatStandsThere) {
  const DrawnMap map{{5, 3}, 0.05, {{{2, 0}, {2.1, 1}}, {{2, 2}, {2.1, 3}}}};
  GeodesicField field(map.grid(), 0.3);
  ASSERT_TRUE(field.measureFrom({1, 1.5}));
  EXPECT_NEAR(field.distance({4, 1.5}), 3.0, 0.1);
  field.setObstacles({{{2.05, 1.5}, 0.2}});
  ASSERT_TRUE(field.measureFrom({1, 1.5}));
  EXPECT_FALSE(std::isfinite(field.distance({4, 1.5})));
  field.setObstacles({});
  ASSERT_TRUE(field.measureFrom({1, 1.5}));
  EXPECT_NEAR(field.distance({4, 1.5}), 3.0, 0.1);
}

TEST(GeodesicField, SaysWhenThereIsNoPlaceToMeasureFrom) {
  const DrawnMap map{{5, 3}, 0.05, {{{0, 0}, {3, 3}}}};
  GeodesicField field(map.grid(), 0.3);
  EXPECT_FALSE(field.measureFrom({1, 1}));
  EXPECT_FALSE(field.measureFrom({-10, 1}));
  EXPECT_FALSE(std::isfinite(field.distance({4, 1.5})));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(field.measureFrom({nan, 1}), std::invalid_argument);
  EXPECT_THROW(GeodesicField(map.grid(), -0.5), std::invalid_argument);
}

TEST(GeodesicField, DoesNotAllocateOnceWarm) {
  std::mt19937 random(2);
  GeodesicField field(test::randomMap(random, 12, 6.0).grid(), 0.3);
  field.measureFrom({3, 3}, 2.0);
  field.measureFrom({1, 1}, 2.0);
  const long before = test::allocations();
  field.measureFrom({3, 3}, 2.0);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace heel
