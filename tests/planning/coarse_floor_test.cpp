// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/map_lines.hpp"
#include <heel/planning/coarse_floor.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

// clang-format off
const std::vector<std::string> kTwoRooms = {  // cells of 0.5 m
    "#########",
    "#...#...#",
    "#.......#",
    "#...#...#",
    "#########",
};
// clang-format on

/// In cells of the map's own size, and a body that fits between its walls.
CoarseFloor twoRooms() { return {test::drawnMap(kTwoRooms, 0.5), 0.5, 0.25}; }

int cellAt(const CoarseFloor& floor, int x, int y) { return y * floor.width() + x; }

TEST(CoarseFloor, IsFreeWhereABodyFits) {
  const CoarseFloor floor = twoRooms();
  int free = 0;
  for (int c = 0; c < floor.cells(); ++c) free += floor.isFree(c) ? 1 : 0;
  EXPECT_EQ(free, 9 + 1 + 9);
  EXPECT_TRUE(floor.isFree(cellAt(floor, 4, 2)));
  EXPECT_FALSE(floor.isFree(cellAt(floor, 4, 1)));
  // Of a body as wide as three cells only the middles of the rooms are free.
  const CoarseFloor wide(test::drawnMap(kTwoRooms, 0.5), 0.5, 0.75);
  EXPECT_TRUE(wide.isFree(cellAt(wide, 2, 2)));
  EXPECT_FALSE(wide.isFree(cellAt(wide, 4, 2)));
}

TEST(CoarseFloor, WalksThroughTheDoorAndCutsNoCorner) {
  const CoarseFloor floor = twoRooms();
  std::vector<float> distance;
  CoarseFloor::Open open;
  floor.walkingDistances(cellAt(floor, 3, 3), distance, open);
  const auto at = [&](int x, int y) {
    return static_cast<double>(distance[static_cast<std::size_t>(cellAt(floor, x, y))]);
  };
  EXPECT_DOUBLE_EQ(at(3, 3), 0.0);
  EXPECT_NEAR(at(2, 2), 0.5 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(at(4, 2), 1.0, 1e-6);  // down, then right: not past the door's post
  EXPECT_NEAR(at(5, 3), 2.0, 1e-6);
  EXPECT_TRUE(std::isinf(at(4, 3)));
}

TEST(CoarseFloor, SeesThroughTheDoorOnly) {
  const CoarseFloor floor = twoRooms();
  EXPECT_TRUE(floor.sees({0.75, 1.25}, {3.75, 1.25}));
  EXPECT_FALSE(floor.sees({0.75, 1.75}, {3.75, 1.75}));
  EXPECT_TRUE(floor.sees({1.6, 1.6}, {2.6, 1.1}));   // aslant through the door
  EXPECT_FALSE(floor.sees({1.9, 1.9}, {2.9, 1.1}));  // past its post
  EXPECT_FALSE(floor.sees({1.25, 1.25}, {-0.5, 1.25}));
  EXPECT_TRUE(floor.sees({1.25, 1.25}, {1.25, 1.25}));
}

TEST(CoarseFloor, SeesTheSameBothWays) {
  const CoarseFloor floor = twoRooms();
  for (int a = 0; a < floor.cells(); ++a) {
    for (int b = 0; b < floor.cells(); ++b) {
      // Not from corner to corner, where either answer is right.
      const Eigen::Vector2d p = floor.center(a) + Eigen::Vector2d(0.03, 0.017);
      const Eigen::Vector2d q = floor.center(b) + Eigen::Vector2d(0.011, -0.023);
      EXPECT_EQ(floor.sees(p, q), floor.sees(q, p)) << a << " " << b;
    }
  }
}

TEST(CoarseFloor, FindsTheNearestFreeCell) {
  const CoarseFloor floor = twoRooms();
  EXPECT_EQ(floor.nearestFree({-3.0, -3.0}), cellAt(floor, 1, 1));
  EXPECT_EQ(floor.nearestFree({2.2, 1.3}), cellAt(floor, 4, 2));
  const CoarseFloor full(test::drawnMap({"##", "##"}, 0.5), 0.5, 0.25);
  EXPECT_EQ(full.nearestFree({0.0, 0.0}), -1);
}

TEST(CoarseFloor, RejectsWhatMakesNoSense) {
  EXPECT_THROW(CoarseFloor(OccupancyGrid(), 0.2, 0.2), std::invalid_argument);
  EXPECT_THROW(CoarseFloor(test::drawnMap({"."}, 0.5), 0.0, 0.2), std::invalid_argument);
  EXPECT_THROW(CoarseFloor(test::drawnMap({"."}, 0.5), 0.5, 0.2), std::invalid_argument);
}

}  // namespace
}  // namespace heel
