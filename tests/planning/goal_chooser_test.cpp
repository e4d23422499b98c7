// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/drive_loop.hpp"
#include <heel/planning/goal_chooser.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace heel {
namespace {

using Eigen::Vector2d;

const auto kOpen = [](const Vector2d&) { return 10.0; };
const auto kSees = [](const Vector2d&, const Vector2d&) { return true; };
const MovingPerson kStanding{{3.0, 0.0}, {0.0, 0.0}, 0.25};

TEST(GoalChooser, StandsAMetreOffOnTheRobotsSide) {
  GoalChooser chooser;
  const auto place = chooser.choose(kStanding, {0, 0}, kOpen, kSees, {});
  ASSERT_TRUE(place);
  EXPECT_NEAR((*place - Vector2d(2.0, 0.0)).norm(), 0.0, 0.02);
}

TEST(GoalChooser, StaysWhereItStandsIfThatWillDo) {
  GoalChooser chooser;
  const Vector2d robot(2.05, 0.1);
  const auto place = chooser.choose(kStanding, robot, kOpen, kSees, {});
  ASSERT_TRUE(place);
  EXPECT_LT((*place - robot).norm(), 0.15);
}

TEST(GoalChooser, DoesNotJitterWithThePersonsPosition) {
  GoalChooser chooser;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.03);
  const auto first = chooser.choose(kStanding, {0, 0}, kOpen, kSees, {});
  for (int i = 0; i < 100; ++i) {
    MovingPerson person = kStanding;
    person.position += Vector2d(noise(random), noise(random));
    const auto place = chooser.choose(person, {0, 0}, kOpen, kSees, {});
    ASSERT_TRUE(place);
    EXPECT_EQ(*place, *first);
  }
  MovingPerson gone = kStanding;
  gone.position.x() += 1.0;
  EXPECT_GT(chooser.choose(gone, {0, 0}, kOpen, kSees, {})->x(), 2.5);
}

TEST(GoalChooser, KeepsOffTheDoorwayThatThePersonWentThrough) {
  const test::DrawnFloor floor = test::roomWithDoorway(0.9);
  const auto clearance = [&](const Vector2d& p) { return floor.clearance(p); };
  const DoorwayOnMap door{{3.0, 2.0}, {1.0, 0.0}, 0.9};
  const MovingPerson person{{3.9, 2.0}, {0.0, 0.0}, 0.25};
  GoalChooser chooser;
  // A metre off on the straight way would be in the doorway.
  const auto blind = chooser.choose(person, {1, 2}, clearance, kSees, {});
  ASSERT_TRUE(blind);
  EXPECT_LT(blind->x(), 3.2);
  EXPECT_GT(inPassage(door, *blind, 0.7, 0.26), 0.5);
  chooser.reset();
  const auto place = chooser.choose(person, {1, 2}, clearance, kSees, {door});
  ASSERT_TRUE(place);
  EXPECT_LT(inPassage(door, *place, 0.7, 0.26), 0.35);
  EXPECT_GT((*place - person.position).norm(), 0.79);
}

TEST(GoalChooser, PrefersPlacesThatSeeThePerson) {
  // A screen hides the person from everywhere with y < 0.3.
  const auto sees = [](const Vector2d& from, const Vector2d&) { return from.y() > 0.3; };
  GoalChooser chooser;
  const auto place = chooser.choose(kStanding, {0, 0}, kOpen, sees, {});
  ASSERT_TRUE(place);
  EXPECT_GT(place->y(), 0.3);
}

// Bug: to see all of somebody who had gone into a room it turned away from them, and lost them.
TEST(GoalChooser, DoesNotTurnAwayFromThePersonForABetterView) {
  const Vector2d robot(2.2, 0.0);
  const auto sees = [](const Vector2d& from, const Vector2d&) { return std::abs(from.y()) > 0.3; };
  GoalChooserParams params;
  params.half_view_rad = M_PI;
  GoalChooser any_way(params), keeps_in_view;
  const auto aside = any_way.choose(kStanding, robot, kOpen, sees, {});
  const auto ahead = keeps_in_view.choose(kStanding, robot, kOpen, sees, {});
  ASSERT_TRUE(aside && ahead);
  const auto off_rad = [&](const Vector2d& place) {
    return std::abs(bearingOf({robot, 0.0}, place));
  };
  EXPECT_GT(off_rad(*aside), 1.0);
  EXPECT_TRUE(*ahead == robot || off_rad(*ahead) < 0.4) << ahead->transpose();
}

TEST(GoalChooser, TakesOnlyPlacesWithRoom) {
  GoalChooser chooser;
  const auto tight = [](const Vector2d& p) { return p.x() < 3.2 ? 0.3 : 1.0; };
  const auto place = chooser.choose(kStanding, {0, 0}, tight, kSees, {});
  ASSERT_TRUE(place);
  EXPECT_GE(place->x(), 3.2);
  const auto nan = [](const Vector2d&) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_FALSE(chooser.choose(kStanding, {0, 0}, nan, kSees, {}));
}

TEST(GoalChooser, KeepsTheDistanceThatAUserSets) {
  for (const double standoff_m : {0.6, 1.8, 2.5}) {
    GoalChooserParams params;
    params.standoff_m = standoff_m;
    const auto place = GoalChooser(params).choose(kStanding, {0, 0}, kOpen, kSees, {});
    ASSERT_TRUE(place) << standoff_m;
    EXPECT_NEAR((*place - kStanding.position).norm(), standoff_m, 1e-6);
  }
}

TEST(GoalChooser, RefusesBadInput) {
  GoalChooser chooser;
  MovingPerson person = kStanding;
  person.velocity.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(chooser.choose(person, {0, 0}, kOpen, kSees, {}));
  GoalChooserParams params;
  params.furthest_share = 0.5;
  EXPECT_THROW(GoalChooser{params}, std::invalid_argument);
  params = {};
  params.standoff_m = 0.0;
  EXPECT_THROW(GoalChooser{params}, std::invalid_argument);
}

}  // namespace
}  // namespace heel
