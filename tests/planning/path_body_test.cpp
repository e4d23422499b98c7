// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Planned paths before another judge: FCL's check of the body against the map as an octree.

#include "tests/planning/drawn_map.hpp"
#include <heel/mapping/body_check.hpp>
#include <heel/mapping/wall_map_builder.hpp>
#include <heel/planning/global_planner.hpp>

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <random>

namespace heel {
namespace {

using test::DrawnMap;

const GlobalPlannerParams kBodyRobot;
constexpr double kWidth_m = 0.31;

BodyCheck checkOn(const WallMap& walls, double radius_m) {
  RobotBody body;
  body.footprint = RoundFootprint{radius_m};
  return {body, *walls.tree()};
}

WallMap wallsOf(const OccupancyGrid& grid) {
  WallMapBuilder builder(grid.cell_size_m());
  builder.add(grid);
  return builder.build();
}

/// Poses of a path, five times as many as the map has cells along it.
std::vector<FloorPose> finePoses(const FloorPath& path, double cell_size_m) {
  std::vector<FloorPose> poses;
  Eigen::Vector2d last = path.front();
  for (const Eigen::Vector2d& at : resample(path, cell_size_m / 5.0)) {
    const Eigen::Vector2d way = at - last;
    poses.push_back({at, std::atan2(way.y(), way.x())});
    last = at;
  }
  return poses;
}

int collisionsOn(const FloorPath& path, const BodyCheck& check, double cell_size_m) {
  int collisions = 0;
  for (const FloorPose& pose : finePoses(path, cell_size_m)) collisions += check.collides(pose);
  return collisions;
}

TEST(PlannedPath, KeepsTheBodyOffTheWallsOfRandomMaps) {
  std::mt19937 random(11);
  int plans = 0;
  for (int i = 0; i < 25; ++i) {
    const DrawnMap map = test::randomMap(random, 18);
    const WallMap walls = wallsOf(map.grid());
    const BodyCheck check = checkOn(walls, kBodyRobot.robot_radius_m);
    GlobalPlanner planner(map.grid(), kBodyRobot);
    for (int k = 0; k < 3; ++k) {
      const GlobalPlan plan = planner.plan(test::randomPlace(random, map, kWidth_m),
                                           test::randomPlace(random, map, kWidth_m));
      if (!plan.found()) continue;
      ++plans;
      EXPECT_EQ(collisionsOn(plan.path, check, map.cell_size_m), 0) << "map " << i;
    }
  }
  EXPECT_GT(plans, 50);
}

TEST(PlannedPath, KeepsTheBodyOffTheWallsThatItsMapWasDrawnFrom) {
  // The other way about: walls that lie askew to the cells, and the map that is read off the tree.
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(0.5, 7.5), side(0.1, 1.2), turn(0.0, 3.1);
  int plans = 0;
  for (int i = 0; i < 15; ++i) {
    WallMapBuilder builder;
    builder.addFreeFloor({0, 0}, {8, 8});
    for (int k = 0; k < 9; ++k) {
      WallBox box;
      box.center = {place(random), place(random)};
      box.size_m = {side(random), side(random)};
      box.yaw_rad = turn(random);
      builder.add(box);
    }
    const WallMap walls = builder.build();
    const BodyCheck check = checkOn(walls, kBodyRobot.robot_radius_m);
    const RobotBody body;
    GlobalPlanner planner(walls.floorGrid({body.bottom_m, body.top_m}), kBodyRobot);
    for (int k = 0; k < 6; ++k) {
      const GlobalPlan plan =
          planner.plan({place(random), place(random)}, {place(random), place(random)});
      if (!plan.found() || plan.escape_m > 0.0) continue;
      ++plans;
      EXPECT_EQ(collisionsOn(plan.path, check, walls.cell_size_m()), 0) << "map " << i;
    }
  }
  EXPECT_GT(plans, 20);
}

TEST(PlannedPath, IsFoundToTouchByABodyThatIsTooWide) {
  // So that the judge is known to judge.
  const DrawnMap map{{6.1, 4}, 0.05, {{{3, 0}, {3.1, 1.6}}, {{3, 2.4}, {3.1, 4}}}};
  const WallMap walls = wallsOf(map.grid());
  const GlobalPlan plan = GlobalPlanner(map.grid(), kBodyRobot).plan({1, 1}, {5, 1});
  ASSERT_TRUE(plan.found());
  EXPECT_EQ(collisionsOn(plan.path, checkOn(walls, kBodyRobot.robot_radius_m), 0.05), 0);
  EXPECT_GT(collisionsOn(plan.path, checkOn(walls, 0.41), 0.05), 0);
}

}  // namespace
}  // namespace heel
