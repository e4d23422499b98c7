// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/drawn_map.hpp"
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/pilot.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr auto kFarFromAll = [](const Vector2d&) {
  return std::numeric_limits<double>::infinity();
};

/// A robot on a floor of 8 m by 4 m that does at once what it is told.
struct Drive {
  RobotDescription robot;
  DriveState state{{{1.0, 2.0}, 0.0}, {}};
  std::vector<MovingPerson> people;
  std::vector<MovingPerson> resting;
  std::vector<test::Box> walls;
  OccupancyGrid things;
  std::vector<float> stood_s;
  std::optional<Pilot> pilot;
  PilotStep last;
  double elapsed_s = 0.1;

  void begin() {
    const FollowerParams params = fittedTo(robot, {});
    floor = test::DrawnMap{{8.0, 4.0}, 0.05, walls}.grid();
    things = OccupancyGrid({0.0, 0.0}, 0.05, floor.width(), floor.height());
    pilot.emplace(floor, params.paths, params.drive, params.give_up_s);
    stood_s.assign(things.cells().size(), 0.0F);
    pilot->setAround(things, stood_s, resting);
  }
  /// From wall to wall, at x = 3 m.
  void bar(Occupancy by) {
    for (int y = 0; y < things.height(); ++y) things.at(GridCell{60, y}) = by;
    pilot->setAround(things, stood_s, resting);
  }
  void step(const Intent& intent) {
    last = pilot->step(intent, state, people, kFarFromAll, kAnyCommand, elapsed_s);
    state = driven(robot.drive, state, last.velocity, elapsed_s);
  }
  /// @return after how many steps it neither drives nor turns where it should be.
  int drive(const Intent& intent, int most = 600) {
    for (int i = 0; i < most; ++i) {
      step(intent);
      if (last.outcome.has_arrived && last.outcome.has_looked) return i;
    }
    return most;
  }

 private:
  OccupancyGrid floor;
};

Intent goTo(const Vector2d& place) {
  Intent intent;
  intent.go_to = place;
  return intent;
}

TEST(Pilot, GoesAroundAWallAndThenLooks) {
  Drive drive;
  drive.walls = {{{3.0, 1.0}, {3.2, 4.0}}};
  drive.begin();
  Intent intent = goTo({5.0, 3.0});
  intent.look_at = Vector2d(5.0, 0.0);
  ASSERT_LT(drive.drive(intent), 600);
  EXPECT_LT((drive.state.pose.position - Vector2d(5.0, 3.0)).norm(), 0.2);
  EXPECT_LT(std::abs(bearingOf(drive.state.pose, *intent.look_at)), 0.15);
  EXPECT_EQ(drive.last.path, nullptr) << "it is on no way any more";
}

TEST(Pilot, LooksNoFasterThanItIsTold) {
  Drive drive;
  drive.begin();
  Intent intent;
  intent.look_at = Vector2d(1.0, 4.0);
  intent.most_turn_radps = 0.3;
  for (int i = 0; i < 100; ++i) {
    drive.step(intent);
    EXPECT_LE(std::abs(drive.last.velocity.turn_radps), 0.3);
    EXPECT_EQ(drive.last.velocity.forward_mps, 0.0);
    EXPECT_FALSE(drive.last.outcome.has_arrived);
  }
  EXPECT_LT(std::abs(bearingOf(drive.state.pose, *intent.look_at)), 0.15);
}

TEST(Pilot, HasArrivedNearEnough) {
  Drive drive;
  drive.begin();
  Intent intent = goTo({5.0, 2.0});
  intent.near_enough_m = 1.0;
  while (!drive.last.outcome.has_arrived) drive.step(intent);
  EXPECT_NEAR(drive.state.pose.position.x(), 4.0, 0.1);
}

TEST(Pilot, HasArrivedWhereNothingLeadsOn) {
  Drive drive;
  drive.walls = {{{3.0, 0.0}, {3.2, 4.0}}};
  drive.begin();
  drive.step(goTo({5.0, 2.0}));
  EXPECT_TRUE(drive.last.outcome.has_arrived);
}

// What is in the way may have gone when the robot is there.
TEST(Pilot, GoesToWhereTheMapLeadsIfThingsBarTheWay) {
  Drive drive;
  drive.begin();
  drive.bar(Occupancy::kOccupied);
  drive.step(goTo({5.0, 2.0}));
  EXPECT_FALSE(drive.last.outcome.has_arrived);
  EXPECT_GT(drive.last.velocity.forward_mps, 0.0);
  for (int i = 0; i < 200; ++i) drive.step(goTo({5.0, 2.0}));
  EXPECT_LT(drive.state.pose.position.x(), 3.0 - drive.robot.drive.radius_m);
  EXPECT_TRUE(drive.last.outcome.has_arrived) << "as near as can be";
}

// Bug: a step counted as a control period, and a robot with a camera of 30 Hz gave up three times
// as soon.
TEST(Pilot, GivesUpAfterTheSameTimeHoweverOftenItIsAsked) {
  std::vector<double> times_s;
  for (const double elapsed_s : {0.1, 0.03}) {
    Drive drive;
    drive.state.pose.position = {2.5, 2.0};
    drive.elapsed_s = elapsed_s;
    drive.begin();
    drive.bar(Occupancy::kOccupied);
    double time_s = 0.0;
    for (; time_s < 60.0 && !drive.last.outcome.has_arrived; time_s += elapsed_s) {
      drive.step(goTo({5.0, 2.0}));
    }
    times_s.push_back(time_s);
  }
  EXPECT_LT(times_s[0], 60.0);
  EXPECT_NEAR(times_s[0], times_s[1], 0.5);
}

TEST(Pilot, PathsLeadAroundWhoStandsAndThroughWhoWalks) {
  Drive drive;
  drive.people = {{{3.0, 2.0}, {0.0, 0.5}, 0.25}};
  drive.begin();
  drive.step(goTo({5.0, 2.0}));
  EXPECT_EQ(drive.last.path->size(), 2U) << "straight on";
  drive.resting = {{{3.0, 2.0}, {0.0, 0.0}, 0.3, 0.0, 5.0}};
  drive.pilot->setAround(drive.things, drive.stood_s, drive.resting);
  drive.step(goTo({5.0, 2.0}));
  EXPECT_GT(drive.last.path->size(), 2U);
}

/// A wall with two gaps; in the nearer one something has stood for a while.
void beginBeforeTwoGaps(Drive& drive, float stood_s) {
  drive.state.pose.position = {2.4, 2.0};
  drive.walls = {{{3.0, 0.0}, {3.2, 1.6}}, {{3.0, 2.4}, {3.2, 3.3}}};
  drive.begin();
  for (int y = 32; y < 48; ++y) {
    drive.things.at(GridCell{62, y}) = Occupancy::kOccupied;
    drive.stood_s[drive.things.index(GridCell{62, y})] = stood_s;
  }
  drive.pilot->setAround(drive.things, drive.stood_s, drive.resting);
}

// Bug: a false match of stereo beside a doorway, or somebody who had stood in it for two seconds,
// sent the robot round through three rooms, and it lost the person who stood behind.
TEST(Pilot, WaitsBeforeWhatHasStoodForLessTimeThanTheWayRoundTakes) {
  for (const float stood_s : {0.0F, 5.0F, 15.0F, 60.0F}) {
    Drive drive;
    beginBeforeTwoGaps(drive, stood_s);
    drive.step(goTo({4.0, 2.0}));
    // It is there after 2.3 s, and round on the other side 7 s later than through.
    EXPECT_EQ(drive.last.path->size() > 2, stood_s > 10.0F) << stood_s << " s";
  }
}

TEST(Pilot, GoesRoundWhatIsStillThereWhenItHasWaited) {
  Drive drive;
  beginBeforeTwoGaps(drive, 0.0F);
  for (int i = 0; i < 600 && !drive.last.outcome.has_arrived; ++i) drive.step(goTo({4.0, 2.0}));
  EXPECT_NEAR((drive.state.pose.position - Vector2d(4.0, 2.0)).norm(), 0.0, 0.2);
}

TEST(Pilot, WaitsForWhoHasStoodForLessTimeThanTheWayRoundTakes) {
  for (const double stood_s : {5.0, 15.0}) {
    Drive drive;
    beginBeforeTwoGaps(drive, 0.0F);
    drive.things = OccupancyGrid({0.0, 0.0}, 0.05, 160, 80);
    drive.resting = {{{3.1, 2.0}, {0.0, 0.0}, 0.3, 0.0, stood_s}};
    drive.pilot->setAround(drive.things, drive.stood_s, drive.resting);
    drive.step(goTo({4.0, 2.0}));
    EXPECT_EQ(drive.last.path->size() > 2, stood_s > 10.0) << stood_s << " s";
  }
}

TEST(Pilot, MakesRoomForWhoWalksAtItWhileItLooks) {
  Drive drive;
  drive.people = {{{1.7, 2.0}, {-0.5, 0.0}, 0.25}};
  drive.begin();
  Intent intent;
  intent.look_at = Vector2d(3.0, 2.0);
  drive.step(intent);
  EXPECT_LT(drive.last.velocity.forward_mps, 0.0);
}

TEST(Pilot, BacksOffFromWhomItLooksAt) {
  Drive drive;
  drive.people = {{{1.6, 2.0}, {0.0, 0.0}, 0.25}};
  drive.begin();
  Intent intent = goTo({0.7, 2.0});
  intent.look_at = intent.keep_in_view = drive.people[0].position;
  ASSERT_LT(drive.drive(intent), 100);
  EXPECT_NEAR(drive.state.pose.position.x(), 0.7, 0.1);
  EXPECT_LT(std::abs(drive.state.pose.yaw_rad), 0.2) << "it never turned its back to them";
}

TEST(Pilot, ALongRobotGoesToWhereItCanTurn) {
  Drive drive;
  drive.robot.drive.radius_m = 0.2;
  drive.robot.drive.front_m = 0.3;
  drive.robot.drive.back_m = -0.3;
  drive.walls = {{{0.0, 2.3}, {3.0, 4.0}}, {{0.0, 0.0}, {3.0, 1.7}}};  // a passage 0.6 m wide
  drive.state.pose.position = {2.2, 2.0};
  drive.begin();
  Intent intent;
  intent.look_at = Vector2d(0.0, 2.0);
  for (int i = 0; i < 600 && std::abs(bearingOf(drive.state.pose, *intent.look_at)) > 0.15; ++i) {
    drive.step(intent);
    const double room_m = roomAround(drive.robot.drive, drive.state.pose,
                                     [&](const Vector2d& p) { return drive.pilot->room_m(p); });
    ASSERT_GT(room_m, 0.0);
  }
  EXPECT_LT(std::abs(bearingOf(drive.state.pose, *intent.look_at)), 0.15);
  EXPECT_GT(drive.state.pose.position.x(), 3.0) << "out of the passage";
}

TEST(Pilot, GoesOnWhenWhatBarredTheWayHasGone) {
  Drive drive;
  drive.begin();
  drive.bar(Occupancy::kOccupied);
  Intent intent = goTo({5.0, 2.0});
  intent.look_at = Vector2d(5.0, 0.0);
  ASSERT_LT(drive.drive(intent), 600) << "it looks from as near as can be";
  EXPECT_LT(drive.state.pose.position.x(), 3.0);
  drive.bar(Occupancy::kFree);
  for (int i = 0; i < 300; ++i) drive.step(intent);
  EXPECT_LT((drive.state.pose.position - Vector2d(5.0, 2.0)).norm(), 0.2);
}

TEST(Pilot, ForgetsWhatBarredTheLastWay) {
  Drive drive;
  drive.walls = {{{3.0, 0.0}, {3.2, 4.0}}};
  drive.begin();
  Intent intent = goTo({5.0, 2.0});
  intent.look_at = Vector2d(5.0, 2.0);
  drive.step(intent);
  ASSERT_TRUE(drive.last.outcome.has_arrived);
  intent.go_to = Vector2d(2.0, 2.0);
  intent.is_new = true;
  drive.step(intent);
  EXPECT_FALSE(drive.last.outcome.has_arrived);
  EXPECT_GT(drive.last.velocity.forward_mps, 0.0);
}

}  // namespace
}  // namespace heel
