// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/people_around.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Upright boxes along the axes, and round things, in a room of 8 m x 6 m; all that a scanner at
/// 10 Hz sees of them. The map shows the room's walls only.
class PeopleAroundTest : public testing::Test {
 protected:
  struct Disc {
    Vector2d center;
    double radius_m = 0.2;
  };
  struct Box {
    Vector2d low, high;
  };

  static double toWalls(const Vector2d& p) {
    return std::min((p - Vector2d(-1.0, -3.0)).minCoeff(), (Vector2d(7.0, 3.0) - p).minCoeff());
  }

  double clearance(const Vector2d& p) const {
    double least = toWalls(p);
    for (const Disc& disc : discs) {
      least = std::min(least, (p - disc.center).norm() - disc.radius_m);
    }
    for (const Box& box : boxes) {
      const Vector2d out = (box.low - p).cwiseMax(p - box.high);
      least = std::min(least, out.cwiseMax(0.0).norm() + std::min(out.maxCoeff(), 0.0));
    }
    return least;
  }

  // Sphere tracing: as far as nothing can be, again and again.
  LaserScan scan() {
    std::normal_distribution<double> noise(0.0, noise_m);
    LaserScan made;
    made.first_rad = -kPi / 2.0;
    made.step_rad = kPi / 180.0;
    for (std::size_t i = 0; i < 181; ++i) {
      const Vector2d along(std::cos(made.angle(i)), std::sin(made.angle(i)));
      double range = 0.0;
      for (double free = 1.0; free > 1e-4 && range < 20.0; range += free) {
        free = clearance(scanner * Vector2d(range * along));
      }
      made.ranges_m.push_back(static_cast<float>(range + noise(random)));
    }
    return made;
  }

  void see(const LaserScan& seen) {
    stamp_s += 0.1;
    people.step(stamp_s, seen, scanner, [](const Vector2d& p) { return toWalls(p); });
  }
  void see() { see(scan()); }

  /// The first disc walks at this velocity while it is watched.
  void walk(const Vector2d& velocity, double for_s) {
    for (int i = 0; i < static_cast<int>(std::lround(for_s * 10.0)); ++i) {
      discs[0].center += 0.1 * velocity;
      see();
    }
  }

  std::mt19937 random{3};
  double noise_m = 0.01;
  FloorPose scanner;
  std::vector<Disc> discs;
  std::vector<Box> boxes;
  double stamp_s = 50.0;
  PeopleAround people;
};

TEST_F(PeopleAroundTest, WhoWalksIsAPersonWithTheirVelocity) {
  for (const Vector2d& velocity : {Vector2d(0.0, 0.7), Vector2d(-0.4, 0.5), Vector2d(0.8, 0.3)}) {
    people = PeopleAround();
    discs = {{Vector2d(2.5, -1.0)}};
    walk(velocity, 2.0);
    ASSERT_EQ(people.people().size(), 1U);
    const MovingPerson& person = people.people()[0];
    EXPECT_NEAR((person.velocity - velocity).norm(), 0.0, 0.2);
    // The scanner sees their near side only.
    EXPECT_NEAR((person.position - discs[0].center).norm(), 0.0, 0.25);
    EXPECT_EQ(person.radius_m, PeopleAroundParams().person_radius_m);
  }
}

TEST_F(PeopleAroundTest, IsSureOfAWalkerWithinAMetre) {
  discs = {{Vector2d(3.0, -1.0)}};
  walk({0.0, 1.0}, 0.3);
  EXPECT_TRUE(people.people().empty()) << "not yet further than what a noise is";
  walk({0.0, 1.0}, 0.7);
  EXPECT_EQ(people.people().size(), 1U);
}

TEST_F(PeopleAroundTest, WhoStopsIsAPersonForAWhileThenAThing) {
  discs = {{Vector2d(2.5, -1.0)}};
  walk({0.0, 0.8}, 1.5);
  walk({0.0, 0.0}, 1.0);
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_NEAR(people.people()[0].velocity.norm(), 0.0, 0.2);
  walk({0.0, 0.0}, 2.0);
  ASSERT_EQ(people.people().size(), 1U) << "a person still";
  EXPECT_EQ(people.walkers().size(), 1U) << "who walked";
  EXPECT_EQ(people.people()[0].velocity.norm(), 0.0);
  walk({0.0, -0.6}, 1.5);
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_LT(people.people()[0].velocity.y(), -0.3) << "who goes on walks again";
  walk({0.0, 0.0}, PeopleAroundParams().stays_s + 1.0);
  EXPECT_TRUE(people.people().empty());
}

TEST_F(PeopleAroundTest, LegsAreOnePersons) {
  for (int i = 0; i < 30; ++i) {
    const double y = -1.0 + 0.07 * i;
    const double stride = 0.15 * std::sin(0.6 * i);
    discs = {{Vector2d(2.4, y + stride), 0.06}, {Vector2d(2.55, y - stride), 0.06}};
    see();
    EXPECT_LE(people.people().size(), 1U) << i;
  }
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_NEAR(people.people()[0].velocity.y(), 0.7, 0.25);
  EXPECT_NEAR(people.people()[0].position.x(), 2.475, 0.15);
}

TEST_F(PeopleAroundTest, TwoWhoWalkApartAreTwo) {
  for (int i = 0; i < 20; ++i) {
    discs = {{Vector2d(2.0, -1.5 + 0.06 * i)}, {Vector2d(3.5, 1.8 - 0.06 * i)}};
    see();
  }
  ASSERT_EQ(people.people().size(), 2U);
  EXPECT_LT(people.people()[0].velocity.y() * people.people()[1].velocity.y(), 0.0);
}

TEST_F(PeopleAroundTest, WhatStandsIsNeverAPerson) {
  boxes = {{{2.0, -0.3}, {2.5, 0.3}}, {{3.0, 1.5}, {3.2, 1.7}}};
  discs = {{Vector2d(1.5, -1.5), 0.05}};
  for (int i = 0; i < 100; ++i) {
    see();
    ASSERT_TRUE(people.people().empty()) << i;
  }
}

TEST_F(PeopleAroundTest, WhatStandsIsNoPersonToARobotThatDrivesAround) {
  boxes = {{{2.0, -0.25}, {2.5, 0.25}}};
  for (int i = 0; i < 150; ++i) {  // Half round the box at 0.3 m/s.
    const double angle = kPi - kPi * i / 150.0;
    scanner = {Vector2d(2.25, 0.0) + 1.4 * Vector2d(std::cos(angle), std::sin(angle)), angle + kPi};
    see();
    ASSERT_TRUE(people.people().empty()) << i;
  }
}

TEST_F(PeopleAroundTest, WhatComesIntoViewFromBehindSomethingDoesNotWalk) {
  boxes = {{{2.9, -0.35}, {3.5, 0.35}}, {{1.0, -0.9}, {1.2, -0.05}}};
  for (int i = 0; i < 60; ++i) {
    scanner.position.y() = -1.2 + 0.03 * i;
    see();
    ASSERT_TRUE(people.people().empty()) << i;
  }
}

TEST_F(PeopleAroundTest, WhatSomebodyPassesCloselyStaysAThing) {
  boxes = {{{2.0, -0.15}, {2.3, 0.15}}};
  discs = {{Vector2d(1.75, -2.0), 0.15}};
  walk({0.0, 0.0}, PeopleAroundParams().thing_after_s + 1.0);
  walk({0.0, 0.7}, 6.0);  // a hand's breadth past it, and on
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_GT(people.people()[0].position.y(), 1.5);
}

TEST_F(PeopleAroundTest, WhoTheCameraSeesStandingIsAPerson) {
  discs = {{Vector2d(2.0, 0.0), 0.15}};
  walk({0.0, 0.0}, PeopleAroundParams().thing_after_s + 1.0);
  ASSERT_TRUE(people.people().empty()) << "the laser alone can't know";
  people.confirm({2.1, 0.1}, 0.4);
  see();
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_EQ(people.people()[0].velocity, Vector2d(0.0, 0.0));
  EXPECT_TRUE(people.walkers().empty()) << "what the camera sees may be furniture, too";
  people.confirm({5.0, 0.0}, 0.4);
  see();
  EXPECT_EQ(people.people().size(), 1U) << "where the laser sees nothing there is nobody to add";
}

TEST_F(PeopleAroundTest, NothingThatTheMapShowsIsAPerson) {
  for (int i = 0; i < 60; ++i) {  // The walls' ends move over the walls as the robot drives.
    scanner.position.x() = 0.03 * i;
    scanner.yaw_rad = 0.01 * i;
    see();
    ASSERT_TRUE(people.people().empty()) << i;
  }
  discs = {{Vector2d(3.0, -2.9), 0.1}};  // At the wall.
  walk({0.7, 0.0}, 3.0);
  EXPECT_TRUE(people.people().empty());
}

TEST_F(PeopleAroundTest, AWideThingIsNoPerson) {
  for (int i = 0; i < 20; ++i) {
    boxes = {{{2.0, -2.0 + 0.08 * i}, {2.3, -0.9 + 0.08 * i}}};
    see();
    ASSERT_TRUE(people.people().empty()) << i;
  }
}

TEST_F(PeopleAroundTest, WhoIsTooFarAwayIsNotLookedFor) {
  discs = {{Vector2d(5.5, -1.5)}};
  walk({0.0, 0.8}, 2.0);
  EXPECT_TRUE(people.people().empty());
}

TEST_F(PeopleAroundTest, BearsBeamsWithoutAnEnd) {
  discs = {{Vector2d(2.0, -0.8)}};
  for (int i = 0; i < 20; ++i) {
    discs[0].center.y() += 0.08;
    LaserScan seen = scan();
    for (std::size_t b = 0; b < seen.ranges_m.size(); ++b) {
      if (b % 7 == 0) seen.ranges_m[b] = kNan;
      if (b % 11 == 0) seen.ranges_m[b] = kInf;
      if (b % 13 == 0) seen.ranges_m[b] = 0.0F;
      if (b % 17 == 0) seen.ranges_m[b] = -1.0F;
    }
    see(seen);
  }
  ASSERT_EQ(people.people().size(), 1U);
  EXPECT_NEAR(people.people()[0].velocity.y(), 0.8, 0.25);
}

TEST_F(PeopleAroundTest, AScanOfNothingForgetsEverybodySoon) {
  discs = {{Vector2d(2.0, -1.0)}};
  walk({0.0, 0.8}, 1.5);
  ASSERT_EQ(people.people().size(), 1U);
  LaserScan nothing = scan();
  for (const float range : {kNan, kInf}) {
    std::fill(nothing.ranges_m.begin(), nothing.ranges_m.end(), range);
    for (int i = 0; i < 4; ++i) see(nothing);
  }
  EXPECT_TRUE(people.people().empty());
  see(LaserScan());
  EXPECT_TRUE(people.people().empty());
}

TEST_F(PeopleAroundTest, WhereTheMapIsUnknownNobodyIsTold) {
  discs = {{Vector2d(2.0, -1.0)}};
  const auto unknown = [](const Vector2d&) { return std::numeric_limits<double>::quiet_NaN(); };
  for (int i = 0; i < 15; ++i) {
    discs[0].center.y() += 0.08;
    people.step(stamp_s += 0.1, scan(), scanner, unknown);
  }
  EXPECT_TRUE(people.people().empty());
}

TEST_F(PeopleAroundTest, FindsThemAgainAfterAJumpOfTheClock) {
  discs = {{Vector2d(2.0, -1.5)}};
  walk({0.0, 0.6}, 1.5);
  ASSERT_EQ(people.people().size(), 1U);
  stamp_s += 3600.0;
  walk({0.0, 0.6}, 1.5);
  EXPECT_EQ(people.people().size(), 1U);
  stamp_s -= 3600.0;
  walk({0.0, 0.6}, 1.5);
  EXPECT_EQ(people.people().size(), 1U);
}

}  // namespace
}  // namespace heel
