// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/occupancy_grid.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

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

TEST(OccupancyGrid, TellsWhetherAnOccupiedCellIsNear) {
  std::mt19937 random(11);
  OccupancyGrid grid({-1.3, 2.7}, 0.1, 30, 20);
  std::vector<GridCell> occupied = {{0, 0}, {29, 19}};
  for (int i = 0; i < 20; ++i) {
    occupied.push_back({static_cast<int>(random() % 30), static_cast<int>(random() % 20)});
  }
  for (const GridCell& cell : occupied) grid.at(cell) = Occupancy::kOccupied;
  std::uniform_real_distribution<double> x(-1.8, 2.2), y(2.2, 5.2), radius(0.0, 0.4);
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector2d point(x(random), y(random));  // also outside of the grid
    double truth = std::numeric_limits<double>::infinity();
    for (const GridCell& cell : occupied) {
      const Eigen::Array2d beyond = (point - grid.center(cell)).array().abs() - 0.05;
      truth = std::min(truth, beyond.max(0.0).matrix().norm());
    }
    const double asked = radius(random);
    EXPECT_EQ(grid.isOccupiedWithin(point, asked), truth <= asked) << point.transpose();
  }
}

TEST(OccupancyGrid, HasNothingNearWhatIsNoPlace) {
  const OccupancyGrid grid({0.0, 0.0}, 0.1, 10, 10, Occupancy::kOccupied);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(grid.isOccupiedWithin({0.5, 0.5}, 0.0));
  EXPECT_FALSE(grid.isOccupiedWithin({nan, 0.5}, 0.1));
  EXPECT_FALSE(grid.isOccupiedWithin({0.5, 1e300}, 0.1));
  EXPECT_FALSE(OccupancyGrid().isOccupiedWithin({0.5, 0.5}, 0.1));
  for (const Eigen::Vector2d& nowhere : {Eigen::Vector2d(nan, 0.5), {0.5, 1e300}, {-1e300, 0.5}}) {
    EXPECT_EQ(grid.at(nowhere), Occupancy::kUnknown) << nowhere.transpose();
  }
}

TEST(OccupancyGrid, RefusesSizesThatAreNone) {
  EXPECT_THROW(OccupancyGrid({0, 0}, 0.0, 1, 1), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid({0, 0}, 0.1, 0, 1), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(OccupancyGrid({nan, 0}, 0.1, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace heel
