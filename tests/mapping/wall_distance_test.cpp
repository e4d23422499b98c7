// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/wall_distance.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

double distanceToCell(const OccupancyGrid& grid, const GridCell& cell, const Vector2d& p) {
  const Vector2d beyond =
      (p - grid.center(cell)).cwiseAbs() - Vector2d::Constant(grid.cell_size_m() / 2.0);
  return beyond.cwiseMax(0.0).norm();
}

TEST(WallDistance, FitsTheFormulaOfAWallAndAPillar) {
  WallMapBuilder builder;
  builder.addFreeFloor({0, 0}, {4, 3});
  builder.add(WallBox{{2.0, 0.05}, 0.0, {4.0, 0.1}, {0.0, 2.0}});
  builder.add(WallCylinder{{2.0, 2.0}, 0.3, {0.0, 2.0}});
  const WallDistance distance(builder.build().floorGrid());
  for (double x = 0.03; x < 3.98; x += 0.11) {
    for (double y = 0.13; y < 2.95; y += 0.07) {
      const double wall = y - 0.1;
      const double pillar = (Vector2d(x, y) - Vector2d(2.0, 2.0)).norm() - 0.3;
      const double truth = std::max(0.0, std::min(wall, pillar));
      // The wall's faces lie on cells' faces; the pillar's rim is of cells.
      EXPECT_NEAR(distance.at({x, y}), truth, wall < pillar - 0.05 ? 1e-6 : 0.036) << x << " " << y;
    }
  }
}

TEST(WallDistance, IsAsCountingAllWallsSays) {
  std::mt19937 random(11);
  OccupancyGrid grid({-1.3, 2.7}, 0.1, 70, 45);
  std::vector<GridCell> walls;
  for (int i = 0; i < 60; ++i) {
    const GridCell cell{static_cast<int>(random() % 70), static_cast<int>(random() % 45)};
    grid.at(cell) = Occupancy::kOccupied;
    walls.push_back(cell);
  }
  walls.push_back({0, 0});
  walls.push_back({69, 44});
  grid.at(walls[60]) = grid.at(walls[61]) = Occupancy::kOccupied;  // At the very border.
  const WallDistance distance(grid, 2.0);
  std::uniform_real_distribution<double> x(-1.3, 5.7), y(2.7, 7.2);
  for (int i = 0; i < 4000; ++i) {
    const Vector2d p(x(random), y(random));
    double truth = 2.0;
    for (const GridCell& wall : walls) truth = std::min(truth, distanceToCell(grid, wall, p));
    EXPECT_NEAR(distance.at(p), truth, 0.01) << p.transpose();
    EXPECT_GE(distance.at(p), truth - 1e-9);
  }
}

TEST(WallDistance, IsItsLargestWhereThereIsNoWall) {
  OccupancyGrid grid({0, 0}, 0.1, 50, 50);
  grid.at(GridCell{0, 0}) = Occupancy::kOccupied;
  grid.at(GridCell{49, 49}) = Occupancy::kUnknown;
  const WallDistance distance(grid, 1.0);
  EXPECT_EQ(distance.at({0.05, 0.05}), 0.0);
  EXPECT_EQ(distance.at({4.95, 4.95}), 1.0) << "unknown is no wall";
  EXPECT_EQ(distance.at({-1.0, 0.05}), 1.0) << "outside";
  EXPECT_EQ(distance.at({std::nan(""), 0.0}), 1.0);
  EXPECT_EQ(WallDistance(OccupancyGrid()).at({0, 0}), 3.0);
  EXPECT_THROW(WallDistance(grid, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace heel
