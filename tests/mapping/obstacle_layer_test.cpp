// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/mapping/seen_obstacles.hpp"
#include "tests/support/allocation_count.hpp"
#include <heel/mapping/obstacle_layer.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using test::around;
using test::occupied;
using test::oneBeam;
using test::seeNothing;
using test::seePoints;
using test::seeScan;
using test::thrice;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ObstacleLayer, IsFreeBeforeTheFirstFrame) {
  const ObstacleLayer layer;
  EXPECT_EQ(layer.window().width(), 320);
  EXPECT_TRUE(layer.obstacles().empty());
  EXPECT_EQ(layer.distance({0.0, 0.0}), kInfinity);
}

TEST(ObstacleLayer, PutsABeamsEndWhereItIsInTheWorld) {
  ObstacleLayer layer;
  layer.begin(0.0, {{10.0, -5.0}, 1.5707963267948966});
  layer.addScan(oneBeam(1.02), {{0.1, 0.22}, 0.0});
  layer.finish();
  // Ahead is the world's y, left its -x.
  ASSERT_EQ(layer.obstacles().size(), 1U);
  EXPECT_TRUE(layer.obstacles()[0].isApprox(Eigen::Vector2d(9.775, -3.875)));
  EXPECT_TRUE(occupied(layer, 9.78, -3.88));
}

TEST(ObstacleLayer, LeavesToTheMapWhatTheMapShows) {
  ObstacleLayer layer;
  const auto is_wall = [](const Eigen::Vector2d& place) { return place.x() > 0.9; };
  layer.begin(0.0, {});
  layer.addScan(oneBeam(1.02), {}, is_wall);
  layer.finish();
  EXPECT_TRUE(layer.obstacles().empty());
  layer.begin(0.1, {});
  layer.addScan(oneBeam(0.8), {}, is_wall);
  layer.finish();
  EXPECT_EQ(layer.obstacles().size(), 1U);
}

TEST(ObstacleLayer, MeasuresTheDistanceToTheNearestObstacle) {
  ObstacleLayer layer;
  seePoints(layer, 0.0, thrice(1.02, 0.03, 0.7));
  EXPECT_NEAR(layer.distance({1.01, 0.01}), 0.0, 1e-9);
  EXPECT_NEAR(layer.distance({0.02, 0.02}), 1.0, 1e-6);
  EXPECT_NEAR(layer.distance({0.02, 0.77}), 1.25, 1e-6);
  // It says at most 1.42 cells more than is true.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-3.9, 3.9);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(place(random), place(random));
    const Eigen::Vector2d nearest =
        p.cwiseMax(Eigen::Vector2d(1.0, 0.0)).cwiseMin(Eigen::Vector2d(1.05, 0.05));
    EXPECT_LE(layer.distance(p), (nearest - p).norm() + 1.42 * 0.05);
    EXPECT_GE(layer.distance(p), (nearest - p).norm() - 0.71 * 0.05);
  }
  EXPECT_EQ(layer.distance({8.1, 0.0}), kInfinity);
  EXPECT_EQ(layer.distance({kNan, 0.0}), kInfinity);
  EXPECT_EQ(layer.distance({1e300, 0.0}), kInfinity);
}

TEST(ObstacleLayer, CountsOnlyPointsThatTheRobotCouldHit) {
  ObstacleLayer layer;
  seePoints(layer, 0.0, thrice(1.0, 0.0, 0.05));
  seePoints(layer, 0.1, thrice(1.0, 0.5, 1.25));
  seePoints(layer, 0.2, thrice(4.1, 0.0, 0.7));
  seePoints(layer, 0.3, thrice(0.1, 0.0, 0.7));  // on the robot itself
  EXPECT_TRUE(layer.obstacles().empty());
  seePoints(layer, 0.4, thrice(1.0, 0.0, 0.07));
  seePoints(layer, 0.5, thrice(1.0, 0.5, 1.19));
  EXPECT_EQ(layer.obstacles().size(), 2U);
}

TEST(ObstacleLayer, NeedsEnoughPointsInACellOfOneFrame) {
  ObstacleLayer layer;
  for (int frame = 0; frame < 5; ++frame) {
    layer.begin(0.1 * frame, {});
    layer.addPoints({{1.01F, 0.01F, 0.7F}, {1.04F, 0.04F, 0.7F}});
    layer.finish();
  }
  EXPECT_TRUE(layer.obstacles().empty());
  layer.begin(1.0, {});
  layer.addPoints({{1.01F, 0.01F, 0.7F}, {1.04F, 0.04F, 0.7F}});
  layer.addPoints({{1.02F, 0.02F, 0.9F}});
  layer.finish();
  EXPECT_EQ(layer.obstacles().size(), 1U);
}

TEST(ObstacleLayer, CountsNothingOfAFrameThatWasNotFinished) {
  ObstacleLayer layer;
  layer.begin(0.0, {});
  layer.addPoints({{1.01F, 0.01F, 0.7F}, {1.04F, 0.04F, 0.7F}});
  layer.begin(0.1, {});
  layer.addPoints({{1.01F, 0.01F, 0.7F}});
  layer.finish();
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, LeavesOutWhatIsNoNumber) {
  ObstacleLayer layer;
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const auto infinite = std::numeric_limits<float>::infinity();
  layer.begin(0.0, {});
  for (int i = 0; i < 3; ++i) {
    layer.addPoints({{nan, 0.0F, 0.7F}, {1.0F, nan, 0.7F}, {1.0F, 0.0F, nan}});
    layer.addPoints({{infinite, 0.0F, 0.7F}, {1.0F, -infinite, 0.7F}, {1.0F, 0.0F, infinite}});
  }
  LaserScan scan = around(8, 0.0);
  scan.ranges_m = {nan, -infinite, infinite, -1.0F, 0.0F, 0.01F, nan, 1e30F};
  layer.addScan(scan, {});
  layer.addScan({}, {});
  layer.finish();
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, ForgetsWithAge) {
  ObstacleLayer layer;
  seePoints(layer, 10.0, thrice(1.0, 0.0, 0.7));
  seeScan(layer, 10.0, oneBeam(1.0, 1.0));
  seeNothing(layer, 10.4);
  EXPECT_EQ(layer.obstacles().size(), 2U);
  seeNothing(layer, 10.6);
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, WhatItSawForAWhileStaysAndAGlimpseIsForgotten) {
  ObstacleLayer layer;
  for (int i = 0; i <= 6; ++i) seePoints(layer, 0.1 * i, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 18.5);
  EXPECT_EQ(layer.obstacles().size(), 1U);
  seeNothing(layer, 18.7);
  EXPECT_TRUE(layer.obstacles().empty()) << "after 30 times 0.6 s";
  for (int i = 0; i <= 30; ++i) seePoints(layer, 20.0 + 0.1 * i, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 82.9);
  EXPECT_EQ(layer.obstacles().size(), 1U);
  seeNothing(layer, 83.1);
  EXPECT_TRUE(layer.obstacles().empty()) << "after a minute";
  for (int i = 0; i <= 4; ++i) seePoints(layer, 90.0 + 0.1 * i, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 91.0);
  EXPECT_TRUE(layer.obstacles().empty()) << "forgotten is forgotten";
}

TEST(ObstacleLayer, TimeInWhichNothingWasSeenAddsNothingToItsMemory) {
  ObstacleLayer layer;
  for (const double from_s : {0.0, 4.0}) {  // Two people walk by.
    for (int i = 0; i <= 3; ++i) seePoints(layer, from_s + 0.1 * i, thrice(1.0, 0.0, 0.7));
  }
  seeNothing(layer, 5.0);
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, ABeamClearsUpToItsEndAndNotBehind) {
  ObstacleLayer layer;
  seeScan(layer, 0.0, oneBeam(1.02));
  seeScan(layer, 0.1, oneBeam(1.52));
  seeScan(layer, 0.2, oneBeam(2.02));
  EXPECT_EQ(layer.obstacles().size(), 3U);  // too recent to clear
  seeScan(layer, 0.5, oneBeam(1.52));
  EXPECT_FALSE(occupied(layer, 1.02, 0.01));
  EXPECT_TRUE(occupied(layer, 1.52, 0.01));
  EXPECT_TRUE(occupied(layer, 2.02, 0.01));
  seeScan(layer, 0.85, oneBeam(kInfinity));
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, ABeamWithoutANumberClearsNothing) {
  ObstacleLayer layer;
  seeScan(layer, 0.0, oneBeam(1.02));
  for (const double range_m : {kNan, 0.0, -kInfinity}) seeScan(layer, 0.5, oneBeam(range_m));
  EXPECT_EQ(layer.obstacles().size(), 1U);
}

TEST(ObstacleLayer, AnEndIsNotClearedByABeamOfTheSameScan) {
  ObstacleLayer layer;
  LaserScan scan;
  scan.step_rad = 0.01;
  scan.first_rad = 0.005;
  scan.ranges_m = {1.02F, 3.0F};  // both through the cell at (1.0, 0.0)
  seeScan(layer, 0.0, scan);
  seeScan(layer, 0.5, scan);
  EXPECT_TRUE(occupied(layer, 1.02, 0.01));
}

TEST(ObstacleLayer, SparseBeamsDoNotClearWhatFitsBetweenThem) {
  ObstacleLayer layer;  // at 1 degree, beams are 5 cm apart at 2.86 m
  seeScan(layer, 0.0, oneBeam(2.52));
  seeScan(layer, 0.0, oneBeam(3.02));
  seeScan(layer, 0.5, around(360, 3.9));
  EXPECT_FALSE(occupied(layer, 2.52, 0.01));
  EXPECT_TRUE(occupied(layer, 3.02, 0.01));
}

TEST(ObstacleLayer, ABeamClearsEveryCellThatItCrosses) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  for (int trial = 0; trial < 50; ++trial) {
    // A field of walls in the laser's sight, then one beam through it.
    ObstacleLayerParams params;
    params.min_points = 1;
    ObstacleLayer layer(params);
    const FloorPose pose{{place(random), place(random)}, angle(random)};
    std::vector<Eigen::Vector3f> points;
    for (int x = -60; x < 60; ++x) {
      for (int y = -60; y < 60; ++y) {
        const Eigen::Vector2d p =
            pose.inverse() * Eigen::Vector2d(0.025 + 0.05 * x, 0.025 + 0.05 * y);
        points.emplace_back(p.cast<float>().x(), p.cast<float>().y(), 0.3F);
      }
    }
    seePoints(layer, 0.0, points, pose);
    const auto before = layer.window().cells();
    seeScan(layer, 0.5, oneBeam(2.0), pose);
    const Eigen::Vector2d way(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
    for (double along = 0.0; along < 1.95; along += 0.001) {
      const Eigen::Vector2d p = pose.position + along * way;
      if (layer.window().cellAt(p) == layer.window().cellAt(pose.position + 2.0 * way)) break;
      ASSERT_FALSE(occupied(layer, p.x(), p.y())) << along;
    }
    int cleared = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      cleared += before[i] != layer.window().cells()[i] ? 1 : 0;
    }
    ASSERT_LE(cleared, 1.95 / 0.05 * 1.42 + 3);
  }
}

TEST(ObstacleLayer, ATableTopSurvivesTheLaserUnderneath) {
  ObstacleLayer layer;
  for (int i = 0; i < 7; ++i) {
    seePoints(layer, 0.1 * i, thrice(1.02, 0.01, 0.72));  // a top
    seePoints(layer, 0.1 * i, thrice(1.52, 0.01, 0.12));  // a low box
  }
  for (int i = 7; i < 30; ++i) seeScan(layer, 0.1 * i, around(720, kInfinity));
  EXPECT_TRUE(occupied(layer, 1.02, 0.01));
  EXPECT_TRUE(occupied(layer, 1.52, 0.01));
}

TEST(ObstacleLayer, WherePeopleAreItRemembersNoLongerThanItMust) {
  ObstacleLayer layer;
  const auto seeSomebodyAtATable = [&](double from_s, const std::vector<FloorDisc>& people) {
    for (int i = 0; i < 20; ++i) {
      layer.begin(from_s + 0.1 * i, {}, std::nullopt, people);
      layer.addPoints(thrice(1.02, 0.02, 0.72));
      layer.addPoints(thrice(1.52, 0.02, 1.0));
      layer.addScan(oneBeam(1.52, 0.5), {});
      layer.finish();
    }
  };
  const std::vector<FloorDisc> somebody{{{1.5, 0.0}, 0.3},
                                        {1.5 * Eigen::Vector2d(std::cos(0.5), std::sin(0.5)), 0.3}};
  seeSomebodyAtATable(0.0, somebody);
  EXPECT_EQ(layer.obstacles().size(), 3U);
  seeNothing(layer, 3.0);
  EXPECT_TRUE(occupied(layer, 1.02, 0.02));
  EXPECT_EQ(layer.obstacles().size(), 1U);
  // Who stands where a thing was known takes nothing from it.
  seeSomebodyAtATable(10.0, {{{1.02, 0.0}, 0.1}});
  seeNothing(layer, 30.0);
  EXPECT_TRUE(occupied(layer, 1.02, 0.02));
}

// A stool's seat, as the robot drives up to it and the camera passes over it.
TEST(ObstacleLayer, WhatTheCameraSawStaysUntilItSeesThroughIt) {
  ObstacleLayer layer;
  const auto seeSeat = [&](double from_s, int frames) {
    for (int i = 0; i < frames; ++i) seePoints(layer, from_s + 0.1 * i, thrice(0.82, 0.02, 0.44));
  };
  const auto look = [&](double stamp_s, bool through) {
    std::vector<Eigen::Vector3f> asked;
    layer.begin(stamp_s, {{0.2, 0.0}, 0.0});
    layer.clear([&](const Eigen::Vector3f& point) {
      asked.push_back(point);
      return through;
    });
    layer.finish();
    return asked;
  };
  seeSeat(0.0, 20);
  EXPECT_TRUE(look(2.0, true).empty()) << "it was seen just now";
  const std::vector<Eigen::Vector3f> asked = look(12.0, false);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_LT((asked[0] - Eigen::Vector3f(0.625F, 0.025F, 0.44F)).norm(), 1e-5F)
      << "in the base frame";
  EXPECT_TRUE(occupied(layer, 0.82, 0.02));
  look(12.1, true);
  EXPECT_FALSE(occupied(layer, 0.82, 0.02));
}

TEST(ObstacleLayer, TellsStepsFromThings) {
  ObstacleLayerParams params;
  params.min_height_m = 0.0;
  ObstacleLayer layer(params);
  auto points = thrice(1.02, 0.02, 0.0);
  for (const Eigen::Vector3f& p : thrice(1.52, 0.02, 0.3)) points.push_back(p);
  for (const Eigen::Vector3f& p : thrice(1.52, 0.02, 0.0)) points.push_back(p);
  seePoints(layer, 0.0, points);
  EXPECT_EQ(layer.obstacles().size(), 2U);
  ASSERT_EQ(layer.steps().size(), 1U);
  EXPECT_LT((layer.steps()[0] - Eigen::Vector2d(1.025, 0.025)).norm(), 1e-6);
  seeNothing(layer, 1.0);
  EXPECT_TRUE(layer.steps().empty());
}

TEST(ObstacleLayer, WhatIsTouchedIsKnownUntilItIsOld) {
  ObstacleLayer layer;
  layer.begin(0.0, {{1.0, 0.0}, 0.0});
  layer.touch({0.32, 0.02});
  layer.finish();
  EXPECT_TRUE(occupied(layer, 1.32, 0.02));
  seeScan(layer, 59.0, around(720, 3.0F));
  EXPECT_TRUE(occupied(layer, 1.32, 0.02)) << "no laser sees it";
  seeScan(layer, 61.0, around(720, 3.0F));
  EXPECT_FALSE(occupied(layer, 1.32, 0.02));
}

TEST(ObstacleLayer, TellsForHowLongThingsHaveStood) {
  ObstacleLayerParams params;
  params.min_height_m = 0.0;
  ObstacleLayer layer(params);
  const auto stood_s = [&layer](double x, double y) {
    return layer.stood_s()[layer.window().index(layer.window().cellAt({x, y}))];
  };
  auto points = thrice(1.02, 0.02, 0.7);
  for (const Eigen::Vector3f& p : thrice(1.52, 0.02, 0.0)) points.push_back(p);
  for (int i = 0; i <= 20; ++i) seePoints(layer, 0.1 * i, points);
  EXPECT_NEAR(stood_s(1.02, 0.02), 2.0F, 1e-3F);
  EXPECT_EQ(stood_s(1.52, 0.02), std::numeric_limits<float>::infinity()) << "a step stays";
  EXPECT_TRUE(std::isnan(stood_s(1.02, 0.52)));
  layer.begin(2.1, {});
  layer.touch({0.32, 0.02});
  layer.finish();
  EXPECT_EQ(stood_s(0.32, 0.02), std::numeric_limits<float>::infinity()) << "what was touched, too";
}

TEST(ObstacleLayer, TheLaserClearsPointsInItsPlane) {
  ObstacleLayer layer;
  auto person = thrice(1.02, 0.01, 1.1);
  person.emplace_back(1.02F, 0.01F, 0.35F);
  seePoints(layer, 0.0, person);
  seeScan(layer, 0.1, around(720, 3.0F));
  EXPECT_TRUE(occupied(layer, 1.02, 0.01));
  seeScan(layer, 0.4, around(720, kInfinity));
  EXPECT_TRUE(occupied(layer, 1.02, 0.01)) << "no laser has an echo of black cloth";
  seeScan(layer, 0.5, around(720, 3.0F));
  EXPECT_FALSE(occupied(layer, 1.02, 0.01));
  // A top that is seen there later is no part of who went.
  seePoints(layer, 0.6, thrice(1.02, 0.01, 0.72));
  seeScan(layer, 1.0, around(720, 3.0F));
  EXPECT_TRUE(occupied(layer, 1.02, 0.01));
}

TEST(ObstacleLayer, LeavesOutTheTargetAndKeepsOtherPeople) {
  ObstacleLayer layer;
  const FloorPose pose{{2.0, 1.0}, 0.0};
  layer.begin(0.0, pose, FloorDisc{{4.0, 1.0}, 0.4});
  for (const double x : {1.7, 1.9, 2.3}) layer.addPoints(thrice(x, 0.0, 1.0));
  layer.addPoints(thrice(2.0, 1.0, 1.0));  // somebody else, one metre to the left
  layer.addScan(oneBeam(1.82), {});
  layer.addScan(oneBeam(1.52), {});
  layer.addScan(oneBeam(1.0, 1.0), {});
  layer.finish();
  ASSERT_EQ(layer.obstacles().size(), 3U);
  EXPECT_TRUE(occupied(layer, 4.0, 2.0));
  EXPECT_TRUE(occupied(layer, 3.52, 1.02));
  EXPECT_FALSE(occupied(layer, 3.82, 1.02));
  // The next frame knows of no target.
  seeScan(layer, 0.1, oneBeam(1.82), pose);
  EXPECT_TRUE(occupied(layer, 3.82, 1.02));
}

TEST(ObstacleLayer, BeamsThatEndOnTheTargetClearTheWayToIt) {
  ObstacleLayer layer;
  seeScan(layer, 0.0, oneBeam(1.02));
  layer.begin(1.0, {}, FloorDisc{{2.0, 0.0}, 0.4});
  layer.addScan(oneBeam(1.8), {});
  layer.finish();
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, ForgetsWhatTheRobotNowStandsOn) {
  ObstacleLayer layer;
  seePoints(layer, 0.0, thrice(0.5, 0.0, 0.7));
  seeNothing(layer, 0.1, {{0.45, 0.0}, 0.0});
  EXPECT_TRUE(layer.obstacles().empty());
}

// Random obstacles in the world, seen by a robot that moves by parts of a cell and by metres.
TEST(ObstacleLayer, KeepsWhatItHoldsWhenTheWindowRolls) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3.9, 3.9);
  std::uniform_real_distribution<double> move(-1.2, 1.2);
  ObstacleLayerParams params;
  params.own_radius_m = 0.0;
  params.min_memory_s = params.max_memory_s = 1e6;
  params.point_range_m = 6.0;
  ObstacleLayer layer(params);
  FloorPose pose{{-0.3, 0.7}, 0.4};
  for (int step = 0; step < 40; ++step) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < 200; ++i) {
      for (int k = 0; k < 3; ++k) points.emplace_back(place(random), place(random), 0.7F);
      points.insert(points.end(), 2, points.back());
    }
    seePoints(layer, 0.1 * step, points, pose);
    const OccupancyGrid before = layer.window();
    const std::size_t many = layer.obstacles().size();
    ASSERT_GT(many, 100U);
    pose.position += (step % 5 == 0 ? 3.0 : 1.0) * Eigen::Vector2d(move(random), move(random));
    seeNothing(layer, 0.1 * step, pose);
    const OccupancyGrid& after = layer.window();
    // Cells of one lattice over the world: the shift is a whole number of cells.
    const Eigen::Vector2d shift = (after.origin_m() - before.origin_m()) / 0.05;
    const GridCell by{static_cast<int>(std::lround(shift.x())),
                      static_cast<int>(std::lround(shift.y()))};
    ASSERT_NEAR(shift.x(), by.x, 1e-9);
    ASSERT_NEAR(shift.y(), by.y, 1e-9);
    for (int y = 0; y < after.height(); ++y) {
      for (int x = 0; x < after.width(); ++x) {
        const GridCell old{x + by.x, y + by.y};
        const Occupancy expected = before.contains(old) ? before.at(old) : Occupancy::kFree;
        ASSERT_EQ(after.at(GridCell{x, y}), expected) << step << ": " << x << ", " << y;
      }
    }
    ASSERT_LT((after.center({160, 160}) - pose.position).cwiseAbs().maxCoeff(), 0.051);
  }
}

TEST(ObstacleLayer, ForgetsAllWhenTheRobotIsCarriedAway) {
  ObstacleLayer layer;
  seePoints(layer, 0.0, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 0.1, {{1e6, -1e6}, 0.0});
  seeNothing(layer, 0.2);
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, AClockSetBackAgesNothingAndAgeingGoesOnFromThere) {
  ObstacleLayer layer;
  seePoints(layer, 100.0, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 100.3);
  seeNothing(layer, 5.0);
  EXPECT_EQ(layer.obstacles().size(), 1U);
  seeNothing(layer, 5.1);  // 0.4 s in all
  EXPECT_EQ(layer.obstacles().size(), 1U);
  seeNothing(layer, 5.3);
  EXPECT_TRUE(layer.obstacles().empty());
  // What is seen after the jump is aged as ever.
  seePoints(layer, 5.6, thrice(1.0, 0.0, 0.7));
  seeNothing(layer, 6.4);
  EXPECT_TRUE(layer.obstacles().empty());
}

TEST(ObstacleLayer, AClockSetForwardKeepsOnlyWhatIsSeenNow) {
  ObstacleLayer layer;
  for (int i = 0; i < 100; ++i) seePoints(layer, 0.1 * i, thrice(1.0, 0.0, 0.7));
  seePoints(layer, 1e9, thrice(1.5, 0.0, 0.7));
  ASSERT_EQ(layer.obstacles().size(), 1U);
  EXPECT_NEAR(layer.obstacles()[0].x(), 1.525, 1e-6);
}

TEST(ObstacleLayer, AllocatesNothingOnceItExists) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> place(-3.9F, 3.9F);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(place(random), place(random), 0.7F);
  LaserScan scan = around(720, 2.0);
  ObstacleLayer layer;
  const long before = test::allocations();
  for (int frame = 0; frame < 30; ++frame) {
    layer.begin(0.03 * frame, {{0.07 * frame, -0.05 * frame}, 0.1 * frame},
                FloorDisc{{1.0, 1.0}, 0.4});
    layer.addScan(scan, {{0.1, 0.0}, 0.0});
    layer.addPoints(points);
    layer.finish();
  }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_GT(layer.obstacles().size(), 1000U);
}

TEST(ObstacleLayer, RefusesWhatIsNoFrame) {
  ObstacleLayer layer;
  EXPECT_THROW(layer.addScan(oneBeam(1.0), {}), std::invalid_argument);
  EXPECT_THROW(layer.addPoints(thrice(1, 0, 1)), std::invalid_argument);
  EXPECT_THROW(layer.finish(), std::invalid_argument);
  EXPECT_THROW(layer.begin(kNan, {}), std::invalid_argument);
  EXPECT_THROW(layer.begin(0.0, {{kNan, 0.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(layer.begin(0.0, {{1e30, 0.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(layer.begin(0.0, {}, FloorDisc{{kNan, 0.0}, 0.4}), std::invalid_argument);
  layer.begin(0.0, {});
  EXPECT_THROW(layer.addScan(oneBeam(1.0, kNan), {}), std::invalid_argument);
  EXPECT_THROW(layer.addScan(oneBeam(1.0), {{kNan, 0.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(layer.addScan(oneBeam(1.0), {{1e12, 0.0}, 0.0}), std::invalid_argument);
}

TEST(ObstacleLayer, RefusesParametersThatAreNone) {
  const auto refused = [](auto change) {
    ObstacleLayerParams params;
    change(params);
    EXPECT_THROW(ObstacleLayer{params}, std::invalid_argument);
  };
  refused([](auto& p) { p.cell_size_m = 0.0; });
  refused([](auto& p) { p.size_m = 0.01; });
  refused([](auto& p) { p.size_m = 1e6; });
  refused([](auto& p) { p.max_height_m = p.min_height_m; });
  refused([](auto& p) { p.point_range_m = kNan; });
  refused([](auto& p) { p.min_points = 0; });
  refused([](auto& p) { p.own_radius_m = -0.1; });
  refused([](auto& p) { p.laser_height_m = kNan; });
  refused([](auto& p) { p.laser_thickness_m = -1.0; });
  refused([](auto& p) { p.laser_max_range_m = p.laser_min_range_m; });
  refused([](auto& p) { p.clear_spacing_m = 0.0; });
  refused([](auto& p) { p.clear_after_s = -1.0; });
  refused([](auto& p) { p.max_memory_s = p.min_memory_s - 0.1; });
}

}  // namespace
}  // namespace heel
