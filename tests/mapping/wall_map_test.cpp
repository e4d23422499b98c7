// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/wall_map.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A wall along y at x = 2 to 2.2 from y = -2 to 2, 2.5 m high, with a doorway of 1 m and 2 m high
/// around y = 0.5; free floor about it.
WallMap wallWithDoorway() {
  WallMapBuilder builder;
  builder.addFreeFloor({0.0, -2.0}, {4.0, 2.0});
  builder.add(WallBox{{2.1, -1.0}, 0.0, {0.2, 2.0}, {0.0, 2.5}});
  builder.add(WallBox{{2.1, 1.5}, 0.0, {0.2, 1.0}, {0.0, 2.5}});
  builder.add(WallBox{{2.1, 0.5}, 0.0, {0.2, 1.0}, {2.0, 2.5}});
  return builder.build();
}

TEST(WallMap, WhatStandsOnFeetIsNoWallToAScannerThatLooksUnderIt) {
  const WallMap map = wallWithDoorway();  // Its lintel begins at 2 m.
  const auto at = [&](double height_m) {
    return map.floorGrid(HeightBand::around(height_m)).at(Vector2d(2.1, 0.5));
  };
  EXPECT_EQ(at(1.99), Occupancy::kFree);
  EXPECT_EQ(at(2.01), Occupancy::kOccupied);
}

TEST(WallMap, KnowsWhereWallsAre) {
  const WallMap map = wallWithDoorway();
  EXPECT_TRUE(map.isWall({2.1, -0.5, 1.0}));
  EXPECT_FALSE(map.isWall({1.95, -0.5, 1.0}));
  EXPECT_FALSE(map.isWall({2.1, 0.5, 1.0})) << "the doorway";
  EXPECT_TRUE(map.isWall({2.1, 0.5, 2.2})) << "over the doorway";
  EXPECT_FALSE(map.isWall({2.1, -0.5, 3.0}));
  EXPECT_FALSE(map.isWall({1e7, 0.0, 1.0})) << "beyond what a tree reaches";
  EXPECT_FALSE(map.isWall({std::nan(""), 0.0, 1.0}));
}

TEST(WallMap, MeasuresToTheFaceOfTheFirstWall) {
  const WallMap map = wallWithDoorway();
  EXPECT_NEAR(map.firstWall({0, -0.5, 1}, {4, -0.5, 1}), 2.0, 1e-6);
  EXPECT_NEAR(map.firstWall({4, -0.5, 1}, {0, -0.5, 1}), 1.8, 1e-6);
  EXPECT_TRUE(std::isinf(map.firstWall({0, 0.5, 1}, {4, 0.5, 1}))) << "through the doorway";
  EXPECT_TRUE(std::isinf(map.firstWall({0, -0.5, 1}, {1.99, -0.5, 1}))) << "in front of the wall";
  EXPECT_NEAR(map.firstWall({0, -0.5, 1}, {2.01, -0.5, 1}), 2.0, 1e-6);
  EXPECT_TRUE(std::isinf(map.firstWall({0, -0.5, 3}, {4, -0.5, 3}))) << "over the wall";
  EXPECT_EQ(map.firstWall({2.1, -0.5, 1}, {4, -0.5, 1}), 0.0) << "from within";
  EXPECT_EQ(map.firstWall({2.1, -0.5, 1}, {2.1, -0.5, 1}), 0.0);
  EXPECT_NEAR(map.firstWall({1.1, -1.5, 1}, {3.1, 0.5, 1}), 0.9 * std::sqrt(2.0), 1e-6);
}

TEST(WallMap, SeesInFrontOfAWallAndThroughDoorwaysOnly) {
  const WallMap map = wallWithDoorway();
  const Vector3d eye(0.5, 0.5, 1.1);
  EXPECT_TRUE(map.lineOfSight(eye, {1.9, -0.5, 1.2}));
  EXPECT_FALSE(map.lineOfSight(eye, {3.0, -0.8, 1.2}));
  EXPECT_TRUE(map.lineOfSight(eye, {3.5, 0.5, 1.2}));
  EXPECT_FALSE(map.lineOfSight(eye, {3.5, 0.5, 3.3})) << "through what is over the doorway";
  // The jamb at (2, 1.0) to (2.2, 1.0): rays to either side of it.
  EXPECT_TRUE(map.lineOfSight({0.5, 0.5, 1}, {3.5, 1.36, 1}));
  EXPECT_FALSE(map.lineOfSight({0.5, 0.5, 1}, {3.5, 1.5, 1}));
  // Half a metre within the wall's other side counts as seen with that margin.
  EXPECT_FALSE(map.lineOfSight({0, -0.5, 1}, {2.4, -0.5, 1}, 0.39));
  EXPECT_TRUE(map.lineOfSight({0, -0.5, 1}, {2.4, -0.5, 1}, 0.41));
  EXPECT_FALSE(map.lineOfSight({0, std::nan(""), 1}, {1, 0, 1}));
}

TEST(WallMap, GrazingAWallIsNotHittingIt) {
  const WallMap map = wallWithDoorway();
  EXPECT_TRUE(map.lineOfSight({1.99, -2, 1}, {1.99, 2, 1}));
  EXPECT_FALSE(map.lineOfSight({2.01, -2.5, 1}, {2.01, 2.5, 1}));
  EXPECT_TRUE(map.lineOfSight({0, 0.5, 1.99}, {4, 0.5, 1.99})) << "just under the lintel";
}

// What style says of castRay: with unknown cells not ignored it ends at the first and tells of no
// hit, which looks like a clear view.
TEST(WallMap, UnknownSpaceNeitherBlocksNorEndsARay) {
  WallMapBuilder builder;  // No free floor: all but the wall is unknown.
  builder.add(WallBox{{2.1, 0.0}, 0.0, {0.2, 2.0}, {0.0, 2.0}});
  const WallMap map = builder.build();
  EXPECT_FALSE(map.lineOfSight({0, 0, 1}, {3, 0, 1}));
  EXPECT_TRUE(map.lineOfSight({0, 0, 1}, {1.9, 0, 1}));
  EXPECT_TRUE(map.lineOfSight({0, 5, 1}, {3, 5, 1}));
  octomap::point3d end;
  EXPECT_FALSE(map.tree()->castRay({0, 0, 1}, {1, 0, 0}, end, false, 3.0)) << "the trap itself";
  EXPECT_TRUE(map.tree()->castRay({0, 0, 1}, {1, 0, 0}, end, true, 3.0));
}

TEST(WallMap, ARayThatLeavesTheTreeEnds) {
  const WallMap map = wallWithDoorway();
  EXPECT_TRUE(std::isinf(map.firstWall({0, 0.5, 1}, {1e7, 0.5, 1})));
  EXPECT_TRUE(std::isinf(map.firstWall({1e7, 0, 1}, {0, 0, 1})));
  EXPECT_NEAR(map.firstWall({0, -0.5, 1}, {1e7, -0.5, 1}), 2.0, 1e-6);
}

TEST(WallMap, NoRayFindsAHoleInAThinWallHoweverTurned) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0.0, M_PI), along(-0.9, 0.9), turn(-0.6, 0.6);
  for (int i = 0; i < 100; ++i) {
    const double yaw = angle(random);
    WallMapBuilder builder;
    builder.add(WallBox{{0.013, 0.021}, yaw, {3.0, 0.01}, {0.0, 2.0}});
    const WallMap map = builder.build();
    for (int j = 0; j < 100; ++j) {
      const Vector2d at = Eigen::Rotation2Dd(yaw) * Vector2d(along(random), 0.0);
      const Vector2d across = Eigen::Rotation2Dd(yaw + turn(random)) * Vector2d(0.0, 0.5);
      const Vector2d a = at + across, b = at - across;
      EXPECT_FALSE(map.lineOfSight({a.x(), a.y(), 1}, {b.x(), b.y(), 1.1})) << yaw;
    }
  }
}

TEST(WallMap, TheFirstWallIsWhereSmallStepsFindIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> where(-2.0, 2.0), height(0.1, 1.9), size(0.05, 0.8);
  WallMapBuilder builder;
  for (int i = 0; i < 12; ++i) {
    builder.add(WallBox{{where(random), where(random)},
                        where(random),
                        {size(random), size(random)},
                        {0.0, height(random)}});
    builder.add(WallCylinder{{where(random), where(random)}, size(random) / 3, {0.2, 1.8}});
  }
  const WallMap map = builder.build();
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d from(where(random), where(random), height(random));
    const Vector3d to(where(random), where(random), height(random));
    const double length = (to - from).norm();
    double stepped = std::numeric_limits<double>::infinity();
    for (double s = 0.0; s <= length && std::isinf(stepped); s += 1e-4) {
      if (map.isWall(from + s / length * (to - from))) stepped = s;
    }
    const double cast = map.firstWall(from, to);
    if (std::isinf(stepped)) {
      // Steps may pass over a corner that a ray cuts by less than one.
      if (!std::isinf(cast)) {
        EXPECT_TRUE(map.isWall(from + (cast + 1e-5) / length * (to - from)));
      }
      continue;
    }
    ++hits;
    EXPECT_LE(cast, stepped + 1e-5);
    if (cast < stepped - 2e-4) {
      const Vector3d inside = from + (cast + 1e-5) / length * (to - from);
      EXPECT_TRUE(map.isWall(inside)) << "a corner that the steps missed";
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(WallMapBuilder, ACellIsWallWhereItsMiddleIs) {
  WallMapBuilder builder(0.1);
  builder.add(WallBox{{1.0, 1.0}, M_PI / 6, {1.0, 0.5}, {0.0, 1.0}});
  builder.add(WallCylinder{{3.0, 1.0}, 0.4, {0.5, 1.0}});
  const WallMap map = builder.build();
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 50; ++x) {
      const Vector2d p(0.1 * (x + 0.5), 0.1 * (y + 0.5));
      const Vector2d q = Eigen::Rotation2Dd(-M_PI / 6) * (p - Vector2d(1.0, 1.0));
      const bool in_box = std::abs(q.x()) <= 0.5 && std::abs(q.y()) <= 0.25;
      const bool in_disc = (p - Vector2d(3.0, 1.0)).norm() <= 0.4;
      EXPECT_EQ(map.isWall({p.x(), p.y(), 0.75}), in_box || in_disc) << p.transpose();
      EXPECT_EQ(map.isWall({p.x(), p.y(), 0.25}), in_box) << p.transpose();
    }
  }
}

TEST(WallMapBuilder, RefusesWhatIsNoWall) {
  EXPECT_THROW(WallMapBuilder(0.0), std::invalid_argument);
  WallMapBuilder builder;
  EXPECT_THROW(builder.add(WallBox{{0, 0}, 0, {-1, 1}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(builder.add(WallBox{{0, 0}, 0, {1, 1}, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(builder.add(WallCylinder{{std::nan(""), 0}, 1, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(builder.add(WallCylinder{{1e6, 0}, 1, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(WallMap(nullptr), std::invalid_argument);
}

TEST(WallMapBuilder, AFloorPlanComesBackAsItsFloorGrid) {
  std::mt19937 random(5);
  OccupancyGrid plan({-1.0, 0.5}, 0.05, 60, 40, Occupancy::kUnknown);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 60; ++x) plan.at(GridCell{x, y}) = static_cast<Occupancy>(random() % 3);
  }
  // The corners are known, so that the grid of all that is known is as large as the plan.
  plan.at(GridCell{0, 0}) = plan.at(GridCell{59, 39}) = Occupancy::kOccupied;
  WallMapBuilder builder;
  builder.add(plan, 2.0);
  const OccupancyGrid floor = builder.build().floorGrid({0.2, 1.5});
  ASSERT_EQ(floor.width(), 60);
  ASSERT_EQ(floor.height(), 40);
  EXPECT_TRUE(floor.origin_m().isApprox(plan.origin_m(), 1e-9));
  EXPECT_EQ(floor.cells(), plan.cells());
}

TEST(WallMapBuilder, NoWallOfAPlanIsLostWhateverItsCells) {
  for (const double cell_m : {0.02, 0.05, 0.13}) {
    OccupancyGrid plan({0.011, 0.017}, cell_m, 40, 40);
    for (int i = 0; i < 40; ++i) plan.at(GridCell{i, 20}) = Occupancy::kOccupied;
    WallMapBuilder builder;
    builder.add(plan, 2.0);
    const WallMap map = builder.build();
    const double wall_y = plan.center({0, 20}).y();
    for (double x = 0.1; x < 40 * cell_m - 0.1; x += 0.007) {
      EXPECT_FALSE(map.lineOfSight({x, wall_y - 0.3, 1}, {x, wall_y + 0.3, 1})) << cell_m;
    }
  }
}

TEST(WallMapBuilder, CloudsMakeWallsAndFreeTheWayToThem) {
  // A camera at (1, 0, 1) that looks along the world's y sees a wall 2 m before it.
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  T_world_camera.translation() = Vector3d(1.0, 0.0, 1.0);
  std::vector<Eigen::Vector3f> points;
  for (int u = -50; u <= 50; ++u) {
    for (int v = -40; v <= 40; ++v) {
      points.emplace_back(0.02F * static_cast<float>(u), 0.02F * static_cast<float>(v), 2.02F);
    }
  }
  points.emplace_back(std::nanf(""), 0.0F, 1.0F);
  points.emplace_back(6.0F, 0.0F, 9.0F);  // Beyond the range.
  WallMapBuilder builder;
  builder.add(points, T_world_camera, 5.0);
  const WallMap map = builder.build();
  EXPECT_TRUE(map.isWall({1.0, 2.02, 1.0}));
  EXPECT_FALSE(map.isWall({1.0, 1.0, 1.0}));
  EXPECT_NEAR(map.firstWall({1, 0, 1}, {1.2, 4, 1}), 2.0, 0.06);
  const OccupancyGrid floor = map.floorGrid({0.2, 1.8});
  EXPECT_EQ(floor.at(Vector2d(1.0, 2.02)), Occupancy::kOccupied);
  EXPECT_EQ(floor.at(Vector2d(1.02, 1.0)), Occupancy::kFree);
  EXPECT_EQ(floor.at(Vector2d(1.0, 3.0)), Occupancy::kUnknown);
  // Lazy insertion leaves inner nodes stale unless they are updated: the root must know the wall.
  EXPECT_TRUE(map.tree()->isNodeOccupied(map.tree()->getRoot()));
}

TEST(WallMap, AnEmptyMapHasNoWallsAndNoFloor) {
  const WallMap map = WallMapBuilder().build();
  EXPECT_TRUE(map.floorGrid().empty());
  EXPECT_TRUE(map.lineOfSight({0, 0, 1}, {5, 0, 1}));
  EXPECT_THROW(map.floorGrid({1.0, 1.0}), std::invalid_argument);
}

TEST(WallMap, TheFloorGridIsOfABandOfHeights) {
  const WallMap map = wallWithDoorway();
  const OccupancyGrid body = map.floorGrid({0.1, 1.9}), high = map.floorGrid({2.1, 2.4});
  EXPECT_EQ(body.at(Vector2d(2.1, 0.5)), Occupancy::kFree) << "the doorway";
  EXPECT_EQ(high.at(Vector2d(2.1, 0.5)), Occupancy::kOccupied) << "what is over it";
  EXPECT_EQ(body.at(Vector2d(2.1, -0.5)), Occupancy::kOccupied);
  EXPECT_EQ(body.at(Vector2d(1.0, 0.0)), Occupancy::kFree);
  EXPECT_EQ(body.at(Vector2d(9.0, 0.0)), Occupancy::kUnknown);
  EXPECT_EQ(map.floorGrid({0.1, 2.0}).at(Vector2d(2.1, 0.5)), Occupancy::kFree) << "it touches";
}

// Bug: with cells of 0.1 m a floor that was seen was a wall.
TEST(WallMap, AFloorIsNoWallHoweverLargeCellsAre) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // looks along the world's x
  T_world_camera.translation() = Vector3d(0.0, 0.0, 1.2);
  std::vector<Eigen::Vector3f> points;
  for (float right_m = -1.0F; right_m < 1.0F; right_m += 0.01F) {
    for (float ahead_m = 1.0F; ahead_m < 3.0F; ahead_m += 0.01F) {
      points.emplace_back(right_m, 1.2F, ahead_m);
    }
    for (float down_m = 0.0F; down_m < 1.2F; down_m += 0.01F) {
      points.emplace_back(right_m, down_m, 3.0F);
    }
  }
  for (const double cell_m : {0.04, 0.05, 0.1, 0.2, 0.4}) {
    SCOPED_TRACE(cell_m);
    WallMapBuilder builder(cell_m);
    builder.add(points, T_world_camera, 5.0);
    const OccupancyGrid floor = builder.build().floorGrid();
    for (double x = 1.0; x < 2.5; x += 0.02) {
      EXPECT_EQ(floor.at(Vector2d(x, 0.02)), Occupancy::kFree) << x;
    }
    EXPECT_EQ(floor.at(Vector2d(3.01, 0.02)), Occupancy::kOccupied);
  }
}

TEST(WallMapBuilder, RefusesCellsThatAreTooFineForItsWalls) {
  WallMapBuilder builder(0.001);
  EXPECT_THROW(builder.addFreeFloor({0.0, 0.0}, {4.0, 4.0}), std::runtime_error);
}

}  // namespace
}  // namespace heel
