// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/wayside.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;

/// A corridor along x, `width_m` wide about y = 0, that opens into a hall at x = 0.
double corridorIntoHall(const Vector2d& p, double width_m) {
  const double beside = 0.5 * width_m - std::abs(p.y());
  if (p.x() >= 0.0) return beside;
  const double to_wall = -p.x();  // the wall in which the corridor begins
  return std::abs(p.y()) < 0.5 * width_m ? std::hypot(to_wall, std::max(beside, 0.0)) : to_wall;
}

const auto kNarrow = [](const Vector2d& p) { return corridorIntoHall(p, 1.0); };
const auto kWide = [](const Vector2d& p) { return corridorIntoHall(p, 1.7); };

TEST(Wayside, LeavesRoomWhereThePersonFitsBetweenRobotAndWall) {
  const Vector2d person(3.0, 0.0);
  EXPECT_FALSE(leavesRoom({2.0, 0.0}, person, kNarrow));
  EXPECT_FALSE(leavesRoom({2.0, 0.0}, person, kWide)) << "neither side of the middle is enough";
  EXPECT_TRUE(leavesRoom({2.0, 0.5}, person, kWide)) << "by the wall of the wide one";
  EXPECT_FALSE(leavesRoom({2.0, 0.15}, person, kNarrow)) << "by the wall of the narrow one";
  EXPECT_TRUE(leavesRoom({-1.5, 0.0}, person, kNarrow));
}

TEST(Wayside, LeavesRoomWithItsBackToAWall) {
  const auto wall = [](const Vector2d& p) { return p.x(); };
  EXPECT_TRUE(leavesRoom({0.4, 5.0}, {1.4, 5.0}, wall));
}

TEST(Wayside, WhatNobodyKnowsIsNoRoom) {
  const auto unknown = [](const Vector2d&) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_FALSE(leavesRoom({0.0, 0.0}, {1.0, 0.0}, unknown));
}

TEST(Wayside, LeavesANarrowCorridorAwayFromThePerson) {
  std::vector<Vector2d> places;
  findWaysides({0.8, 0.0}, {{1.8, 0.0}}, kNarrow, {}, {}, places);
  ASSERT_FALSE(places.empty());
  for (const Vector2d& place : places) {
    EXPECT_LT(place.x(), 0.0) << place.transpose();
    EXPECT_TRUE(leavesRoom(place, {1.8, 0.0}, kNarrow));
    EXPECT_GE(kNarrow(place), 0.34);
  }
  const auto isNearer = [](const Vector2d& a, const Vector2d& b) {
    return (a - Vector2d(0.8, 0.0)).norm() < (b - Vector2d(0.8, 0.0)).norm() - 1e-9;
  };
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end(), isNearer));
}

TEST(Wayside, KeepsOutOfTheWayThroughADoorway) {
  const DoorwayOnMap end{{0.0, 0.0}, {1.0, 0.0}, 1.0};
  const WaysideParams params;
  std::vector<Vector2d> places;
  findWaysides({0.8, 0.0}, {{1.8, 0.0}}, kNarrow, {end}, params, places);
  ASSERT_FALSE(places.empty());
  for (const Vector2d& place : places) {
    EXPECT_TRUE(-place.x() >= params.doorway_depth_m || std::abs(place.y()) >= 0.5 + 0.26)
        << place.transpose();
  }
}

// Bug: it made room for the one behind it, towards the one who stood in the door before it, and
// stayed in that door for a minute.
TEST(Wayside, DoesNotGoTowardsAnybodyElse) {
  std::vector<Vector2d> places;
  findWaysides({0.8, 0.0}, {{1.8, 0.0}, {-0.4, 0.0}}, kNarrow, {}, {}, places);
  EXPECT_TRUE(places.empty());
}

TEST(Wayside, LeavesADoorwayEvenWhereNobodyCanWalkBy) {
  const DoorwayOnMap side{{3.0, 0.5}, {0.0, 1.0}, 0.9};  // into a corridor that is too narrow
  std::vector<Vector2d> places;
  const auto endless = [](const Vector2d& p) { return 0.5 - std::abs(p.y()); };
  findWaysides({3.0, 0.0}, {{3.0, 0.7}}, endless, {side}, {}, places);
  ASSERT_FALSE(places.empty());
  EXPECT_GE(std::abs(places.front().x() - 3.0), 0.45);
}

TEST(Wayside, ThereIsNoneInACorridorThatHasNoEnd) {
  const auto endless = [](const Vector2d& p) { return 0.5 - std::abs(p.y()); };
  std::vector<Vector2d> places{{1.0, 1.0}};
  findWaysides({0.0, 0.0}, {{1.0, 0.0}}, endless, {}, {}, places);
  EXPECT_TRUE(places.empty());
}

}  // namespace
}  // namespace heel
