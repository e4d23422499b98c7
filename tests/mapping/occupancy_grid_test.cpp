// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/occupancy_grid.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace heel {
namespace {

TEST(OccupancyGrid, FindsTheCellOfAPointAndItsMiddle) {
  const OccupancyGrid grid({-1.0, 2.0}, 0.5, 4, 2);
  EXPECT_EQ(grid.cellAt({-1.0, 2.0}), (GridCell{0, 0}));
  EXPECT_EQ(grid.cellAt({0.99, 2.99}), (GridCell{3, 1}));
  EXPECT_EQ(grid.cellAt({-1.01, 1.99}), (GridCell{-1, -1}));
  EXPECT_TRUE(grid.center({3, 1}).isApprox(Eigen::Vector2d(0.75, 2.75)));
}

TEST(OccupancyGrid, KnowsNothingOfWhatIsOutside) {
  OccupancyGrid grid({0.0, 0.0}, 0.1, 10, 10);
  grid.at(GridCell{2, 3}) = Occupancy::kOccupied;
  EXPECT_EQ(grid.at(Eigen::Vector2d(0.25, 0.35)), Occupancy::kOccupied);
  EXPECT_EQ(grid.at(Eigen::Vector2d(0.35, 0.25)), Occupancy::kFree);
  EXPECT_EQ(grid.at(Eigen::Vector2d(1.05, 0.35)), Occupancy::kUnknown);
}

TEST(OccupancyGrid, RefusesSizesThatAreNone) {
  EXPECT_THROW(OccupancyGrid({0, 0}, 0.0, 1, 1), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid({0, 0}, 0.1, 0, 1), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(OccupancyGrid({nan, 0}, 0.1, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace heel
