// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/follow_run.hpp"
#include <heel/apps/pictures/map_picture.hpp>

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <vector>

namespace {

using Eigen::Vector2d;
using heel::GridCell;
using heel::Occupancy;
using heel::OccupancyGrid;
using heel::outlinePath;

/// The area that a path encloses by the even-odd rule if no loop lies in two others: outer loops
/// are positive, holes negative.
double areaOf(const std::string& path) {
  double area = 0.0, x = 0.0, y = 0.0, x0 = 0.0, y0 = 0.0;
  std::istringstream in(path);
  for (char step; in >> step;) {
    const double before_x = x, before_y = y;
    if (step == 'M') {
      in >> x >> y;
      x0 = x;
      y0 = y;
      continue;
    }
    if (step == 'H') in >> x;
    if (step == 'V') in >> y;
    if (step == 'Z') {
      x = x0;
      y = y0;
    }
    area += 0.5 * (before_x * y - x * before_y);
  }
  return std::abs(area);
}

TEST(OutlinePath, OfABlockIsItsRectangle) {
  OccupancyGrid grid({0.0, 0.0}, 1.0, 5, 4);
  for (GridCell cell{1, 1}; cell.x < 4; ++cell.x) grid.at(cell) = Occupancy::kOccupied;
  EXPECT_EQ(outlinePath(grid, Occupancy::kOccupied, {0.0, 4.0}), "M4.00 3.00V2.00H1.00V3.00Z");
  EXPECT_EQ(outlinePath(grid, Occupancy::kUnknown, {0.0, 4.0}), "");
}

TEST(OutlinePath, GoesAroundHolesAndCorners) {
  OccupancyGrid grid({0.0, 0.0}, 1.0, 5, 5);
  for (GridCell cell; cell.y < 3; ++cell.y) {
    for (cell.x = 0; cell.x < 3; ++cell.x) grid.at(cell) = Occupancy::kOccupied;
  }
  grid.at(GridCell{1, 1}) = Occupancy::kFree;
  grid.at(GridCell{3, 3}) = Occupancy::kOccupied;  // touches at a corner
  EXPECT_DOUBLE_EQ(areaOf(outlinePath(grid, Occupancy::kOccupied, {0.0, 5.0})), 9.0);
}

TEST(OutlinePath, EnclosesAsMuchAsThereAreCells) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    OccupancyGrid grid({-1.0, 2.0}, 0.5, 12, 9);
    int cells = 0;
    for (GridCell cell; cell.y < grid.height(); ++cell.y) {
      for (cell.x = 0; cell.x < grid.width(); ++cell.x) {
        if (random() % 2 != 0) continue;
        grid.at(cell) = Occupancy::kOccupied;
        ++cells;
      }
    }
    EXPECT_NEAR(areaOf(outlinePath(grid, Occupancy::kOccupied, {-1.0, 6.5})), 0.25 * cells, 1e-9);
  }
}

TEST(OutlinePath, OfAFlatIsSmall) {
  EXPECT_LT(outlinePath(heel::test::flatMap(), Occupancy::kOccupied, {0.0, 8.0}).size(), 2000U);
}

TEST(OccupiedBounds, HoldAllOccupiedCells) {
  OccupancyGrid grid({1.0, 1.0}, 0.5, 10, 10);
  EXPECT_TRUE(heel::occupiedBounds(grid).isEmpty());
  grid.at(GridCell{2, 4}) = Occupancy::kOccupied;
  EXPECT_TRUE(heel::occupiedBounds(grid).min().isApprox(Vector2d(2.0, 3.0)));
  EXPECT_TRUE(heel::occupiedBounds(grid).max().isApprox(Vector2d(2.5, 3.5)));
}

}  // namespace
