// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/drawn_map.hpp"
#include "tests/support/allocation_count.hpp"
#include <heel/planning/global_planner.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

using test::DrawnMap;

/// Radius 0.3 m; with the safety 0.31 m.
const GlobalPlannerParams kRobot;
constexpr double kBody_m = 0.31;

/// Two rooms of 3 m, with a doorway around (3.05, 2) of this width; 4 m in y.
DrawnMap twoRooms(double door_m) {
  return {{6.1, 4}, 0.05, {{{3, 0}, {3.1, 2 - door_m / 2}}, {{3, 2 + door_m / 2}, {3.1, 4}}}};
}

void expectClear(const DrawnMap& map, const FloorPath& path, double radius_m) {
  const FloorPath fine = resample(path, 0.01);
  for (const Eigen::Vector2d& p : fine) {
    EXPECT_GE(test::clearanceOf(map, p, p), radius_m - 1e-9) << p.transpose();
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_GE(test::clearanceOf(map, path[i - 1], path[i]), radius_m - 1e-9);
  }
}

TEST(GlobalPlanner, GoesStraightWhereNothingIsInTheWay) {
  GlobalPlanner planner(DrawnMap{{5, 5}, 0.05, {}}.grid(), kRobot);
  const GlobalPlan plan = planner.plan({1, 1}, {4, 3.5});
  EXPECT_EQ(plan.status, PlanStatus::kFound);
  EXPECT_EQ(plan.path, (FloorPath{{1, 1}, {4, 3.5}}));
  EXPECT_DOUBLE_EQ(plan.length_m, std::hypot(3.0, 2.5));
  EXPECT_EQ(planner.plan({1, 1}, {1, 1}).length_m, 0.0);
}

TEST(GlobalPlanner, GoesRoundACornerAlongItsTangents) {
  // A wall from below to (3, 3); the way is two tangents of its corner's circle and an arc.
  const DrawnMap map{{6, 6}, 0.05, {{{2.5, 0}, {3, 3}}, {{2.5, 0}, {2.6, 3}}}};
  GlobalPlanner planner(map.grid(), kRobot);
  const Eigen::Vector2d start(2.75, 4.0), goal(4.0, 1.0), corner(3, 3);
  const double from = (start - corner).norm(), to = (goal - corner).norm();
  const Eigen::Vector2d a = (start - corner) / from, b = (goal - corner) / to;
  const double arc = std::acos(a.dot(b)) - std::acos(kBody_m / from) - std::acos(kBody_m / to);
  const double truth = std::sqrt(from * from - kBody_m * kBody_m) +
                       std::sqrt(to * to - kBody_m * kBody_m) + kBody_m * arc;
  ASSERT_GT(arc, 0.0);
  const GlobalPlan plan = planner.plan(start, goal);
  EXPECT_EQ(plan.status, PlanStatus::kFound);
  EXPECT_GE(plan.length_m, truth - 1e-9);
  EXPECT_LE(plan.length_m, 1.01 * truth);
  expectClear(map, plan.path, kBody_m);
}

TEST(GlobalPlanner, GivesBendsRoomWhereThereIs) {
  const DrawnMap map = twoRooms(1.2);
  GlobalPlannerParams roomy = kRobot;
  roomy.bend_room_m = 0.15;
  const Eigen::Vector2d start(1, 0.6), goal(5, 0.6);
  const GlobalPlan close = GlobalPlanner(map.grid(), kRobot).plan(start, goal);
  GlobalPlanner planner(map.grid(), roomy);
  const GlobalPlan wide = planner.plan(start, goal);
  expectClear(map, wide.path, kBody_m);
  const auto least = [&](const FloorPath& path) {
    double room = 9.0;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      room = std::min(room, planner.clearance().clearance(path[i]));
    }
    return room;
  };
  ASSERT_GT(close.path.size(), 2U);
  EXPECT_GT(least(wide.path), least(close.path) + 0.1);
  EXPECT_LT(wide.length_m, 1.05 * close.length_m);
  // In a doorway just wide enough there is none, and it goes through all the same.
  const DrawnMap narrow = twoRooms(0.7);
  EXPECT_EQ(GlobalPlanner(narrow.grid(), roomy).plan({1, 1}, {5, 1}).status, PlanStatus::kFound);
}

TEST(GlobalPlanner, GoesThroughADoorwayJustWideEnough) {
  const DrawnMap wide = twoRooms(0.7), narrow = twoRooms(0.6);
  GlobalPlanner through(wide.grid(), kRobot), shut(narrow.grid(), kRobot);
  const GlobalPlan plan = through.plan({1, 1}, {5, 1});
  EXPECT_EQ(plan.status, PlanStatus::kFound);
  expectClear(wide, plan.path, kBody_m);
  EXPECT_EQ(shut.plan({1, 1}, {5, 1}).status, PlanStatus::kGoalUnreachable);
  GlobalPlannerParams slim = kRobot;
  slim.robot_radius_m = 0.289;  // With its safety a millimetre less than half of the doorway.
  EXPECT_EQ(GlobalPlanner(narrow.grid(), slim).plan({1, 1}, {5, 1}).status, PlanStatus::kFound);
}

TEST(GlobalPlanner, IsNearlyTheShortestClearWayOnRandomMaps) {
  std::mt19937 random(1);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const DrawnMap map = test::randomMap(random, 18);
    GlobalPlanner planner(map.grid(), kRobot);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d start = test::randomPlace(random, map, kBody_m);
      const Eigen::Vector2d goal = test::randomPlace(random, map, kBody_m);
      const double truth = test::shortestWay(map, kBody_m, start, goal);
      const GlobalPlan plan = planner.plan(start, goal);
      if (plan.status != PlanStatus::kFound) {
        EXPECT_FALSE(std::isfinite(test::shortestWay(map, kBody_m + 0.005, start, goal)));
        continue;
      }
      ++compared;
      EXPECT_LE(plan.length_m, 1.05 * truth) << "map " << i;
      EXPECT_GE(plan.length_m, 0.99 * truth) << "the oracle's arcs are some thousandths too long";
      expectClear(map, plan.path, kBody_m);
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(GlobalPlanner, GoesThroughANarrowDoorwayWhereverItsCellsLie) {
  for (int shift = 0; shift < 3; ++shift) {
    const double s = 0.05 * shift;
    const DrawnMap map{{6.1 + s, 4 + s},
                       0.05,
                       {{{3 + s, 0}, {3.1 + s, 1.65 + s}}, {{3 + s, 2.35 + s}, {3.1 + s, 4 + s}}}};
    const GlobalPlan plan = GlobalPlanner(map.grid(), kRobot).plan({1, 1}, {5, 1});
    ASSERT_EQ(plan.status, PlanStatus::kFound);
    EXPECT_LE(plan.length_m, 1.05 * test::shortestWay(map, kBody_m, {1, 1}, {5, 1}));
  }
}

TEST(GlobalPlanner, IsTheSameEachTime) {
  std::mt19937 random(10);
  const DrawnMap map = test::randomMap(random, 15);
  FloorPath places;
  for (int i = 0; i < 30; ++i) places.push_back(test::randomPlace(random, map, kBody_m));
  GlobalPlanner one(map.grid(), kRobot), other(map.grid(), kRobot);
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_EQ(one.plan(places[i - 1], places[i]).path, other.plan(places[i - 1], places[i]).path);
  }
}

TEST(GlobalPlanner, FollowsAMovingGoalAsIfItPlannedAnew) {
  std::mt19937 random(6);
  int kept = 0;
  for (int i = 0; i < 25; ++i) {
    const DrawnMap map = test::randomMap(random, 15);
    const OccupancyGrid grid = map.grid();
    GlobalPlanner planner(grid, kRobot), fresh(grid, kRobot);
    const Eigen::Vector2d start = test::randomPlace(random, map, kBody_m);
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector2d goal = test::randomPlace(random, map, kBody_m);
      fresh.forget();
      const GlobalPlan a = planner.plan(start, goal), b = fresh.plan(start, goal);
      ASSERT_EQ(a.status, b.status);
      EXPECT_NEAR(a.length_m, b.length_m, 0.03 * b.length_m);
      if (a.found()) expectClear(map, a.path, kBody_m);
      kept += a.found() && !a.searched_anew ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 50);
}

TEST(GlobalPlanner, KeepsItsSearchWhileTheRobotGoesOn) {
  std::mt19937 random(7);
  int anew = 0, plans = 0;
  for (int i = 0; i < 25; ++i) {
    const DrawnMap map = test::randomMap(random, 15);
    GlobalPlanner planner(map.grid(), kRobot);
    Eigen::Vector2d robot = test::randomPlace(random, map, kBody_m);
    const Eigen::Vector2d goal = test::randomPlace(random, map, kBody_m);
    GlobalPlan plan = planner.plan(robot, goal);
    for (int k = 0; k < 20 && plan.found() && plan.path.size() > 2; ++k) {
      robot = resample(plan.path, 0.15)[1];
      plan = planner.plan(robot, goal);
      ASSERT_TRUE(plan.found());
      expectClear(map, plan.path, kBody_m);
      EXPECT_LE(plan.length_m, 1.05 * test::shortestWay(map, kBody_m, robot, goal) + 0.02);
      anew += plan.searched_anew ? 1 : 0;
      ++plans;
    }
  }
  EXPECT_LT(anew, plans / 2);
}

TEST(GlobalPlanner, GoesRoundWhatBlocksADoorway) {
  // Two doorways, at y = 1 and y = 5; the near one is blocked for a while.
  const DrawnMap map{
      {6.1, 6}, 0.05, {{{3, 0}, {3.1, 0.5}}, {{3, 1.5}, {3.1, 4.5}}, {{3, 5.5}, {3.1, 6}}}};
  GlobalPlanner planner(map.grid(), kRobot);
  const Eigen::Vector2d start(1, 2), goal(5, 2);
  const GlobalPlan before = planner.plan(start, goal);
  planner.setObstacles({{{3.05, 1.0}, 0.25}});
  const GlobalPlan around = planner.plan(start, goal);
  EXPECT_FALSE(around.searched_anew);
  EXPECT_EQ(around.status, PlanStatus::kFound);
  EXPECT_GT(around.length_m, before.length_m + 1.0);
  expectClear(map, around.path, kBody_m);
  planner.setObstacles({{{3.05, 1.0}, 0.25}, {{3.05, 5.0}, 0.25}});
  EXPECT_EQ(planner.plan(start, goal).status, PlanStatus::kGoalUnreachable);
  planner.setObstacles({});
  EXPECT_NEAR(planner.plan(start, goal).length_m, before.length_m, 1e-9);
}

TEST(GlobalPlanner, MendsItsSearchToWhatItWouldBeAnew) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(0.0, 8.0), radius(0.05, 0.4);
  int kept = 0;
  for (int i = 0; i < 15; ++i) {
    const DrawnMap map = test::randomMap(random, 10);
    const OccupancyGrid grid = map.grid();
    GlobalPlanner planner(grid, kRobot), fresh(grid, kRobot);
    const Eigen::Vector2d start = test::randomPlace(random, map, kBody_m);
    for (int k = 0; k < 10; ++k) {
      std::vector<FloorDisc> discs;
      for (int d = 0; d < 4; ++d) discs.push_back({{place(random), place(random)}, radius(random)});
      planner.setObstacles(discs);
      fresh.setObstacles(discs);
      fresh.forget();
      const Eigen::Vector2d goal = test::randomPlace(random, map, kBody_m);
      const GlobalPlan a = planner.plan(start, goal), b = fresh.plan(start, goal);
      ASSERT_EQ(a.status, b.status);
      if (a.escape_m == 0.0) {
        for (std::size_t p = 1; p < a.path.size(); ++p) {
          ASSERT_TRUE(fresh.clearance().isClear(a.path[p - 1], a.path[p], kBody_m));
        }
      }
      EXPECT_NEAR(a.length_m, b.length_m, 0.03 * b.length_m);
      kept += a.found() && !a.searched_anew ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 50);
}

TEST(GlobalPlanner, LeavesAPlaceThatIsTooNearToAWall) {
  const DrawnMap map{{6, 4}, 0.05, {{{0, 0}, {6, 1}}, {{3, 1}, {3.1, 3}}}};
  GlobalPlanner planner(map.grid(), kRobot);
  const Eigen::Vector2d start(1, 1.12);
  const GlobalPlan plan = planner.plan(start, {5, 2});
  ASSERT_EQ(plan.status, PlanStatus::kFound);
  EXPECT_GT(plan.escape_m, 0.15);
  EXPECT_LT(plan.escape_m, 0.3);
  EXPECT_EQ(plan.path.front(), start);
  expectClear(map, {start, plan.path[1]}, 0.12 - 1e-6);
  expectClear(map, FloorPath(plan.path.begin() + 1, plan.path.end()), kBody_m);
}

TEST(GlobalPlanner, EndsNearAGoalThatIsInAWall) {
  const DrawnMap map = twoRooms(0.9);
  GlobalPlanner planner(map.grid(), kRobot);
  const GlobalPlan plan = planner.plan({1, 1}, {3.05, 0.5});
  ASSERT_EQ(plan.status, PlanStatus::kFoundNearby);
  EXPECT_EQ(plan.end, plan.path.back());
  EXPECT_LT((plan.end - Eigen::Vector2d(3.05, 0.5)).norm(), 0.5);
  expectClear(map, plan.path, kBody_m);
  GlobalPlannerParams strict = kRobot;
  strict.goal_tolerance_m = 0.1;
  EXPECT_EQ(GlobalPlanner(map.grid(), strict).plan({1, 1}, {3.05, 0.5}).status,
            PlanStatus::kGoalUnreachable);
}

TEST(GlobalPlanner, SaysWhyThereIsNoPath) {
  const DrawnMap map{{6, 4}, 0.05, {{{3, 0}, {3.5, 4}}}};
  GlobalPlanner planner(map.grid(), kRobot);
  EXPECT_EQ(planner.plan({-1, 1}, {5, 1}).status, PlanStatus::kStartOutside);
  EXPECT_EQ(planner.plan({1, 1}, {5, 40}).status, PlanStatus::kGoalOutside);
  EXPECT_EQ(planner.plan({3.2, 1}, {5, 1}).status, PlanStatus::kStartBlocked);
  const GlobalPlan plan = planner.plan({1, 1}, {5, 1});
  EXPECT_EQ(plan.status, PlanStatus::kGoalUnreachable);
  EXPECT_TRUE(plan.path.empty());
  EXPECT_STREQ(nameOf(plan.status), "goal_unreachable");
}

TEST(GlobalPlanner, KeepsOffTheUnknownUnlessToldOtherwise) {
  OccupancyGrid grid = DrawnMap{{6, 4}, 0.05, {}}.grid();
  for (int y = 0; y < grid.height(); ++y) grid.at(GridCell{60, y}) = Occupancy::kUnknown;
  EXPECT_FALSE(GlobalPlanner(grid, kRobot).plan({1, 2}, {5, 2}).found());
  GlobalPlannerParams bold = kRobot;
  bold.unknown_is_free = true;
  EXPECT_DOUBLE_EQ(GlobalPlanner(grid, bold).plan({1, 2}, {5, 2}).length_m, 4.0);
}

TEST(GlobalPlanner, RefusesWhatIsNone) {
  EXPECT_THROW(GlobalPlanner(OccupancyGrid(), kRobot), std::invalid_argument);
  GlobalPlanner planner(DrawnMap{{6, 4}, 0.05, {}}.grid(), kRobot);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(planner.plan({nan, 1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(planner.plan({1, 1}, {1, nan}), std::invalid_argument);
  GlobalPlannerParams wrong;
  wrong.robot_radius_m = -1.0;
  EXPECT_THROW(GlobalPlanner(DrawnMap{{6, 4}, 0.05, {}}.grid(), wrong), std::invalid_argument);
}

TEST(GlobalPlanner, DoesNotAllocateOnceWarm) {
  std::mt19937 random(9);
  const DrawnMap map = test::randomMap(random, 15);
  GlobalPlanner planner(map.grid(), kRobot);
  FloorPath places;
  for (int i = 0; i < 20; ++i) places.push_back(test::randomPlace(random, map, kBody_m));
  const std::vector<FloorDisc> none, some = {{{4, 4}, 0.3}, {{6, 2}, 0.2}};
  GlobalPlan plan;
  const auto work = [&] {
    for (std::size_t i = 1; i < places.size(); ++i) {
      planner.setObstacles(i % 2 == 0 ? none : some);
      planner.plan(places[i - 1], places[i], plan);
    }
  };
  work();
  work();
  const long before = test::allocations();
  work();
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace heel
