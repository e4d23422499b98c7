// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/allocation_count.hpp"
#include "tests/support/drive_loop.hpp"
#include <heel/planning/local_planner.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;
using test::DrawnFloor;
using test::DriveLoop;
using test::LineWalker;

using Path = std::vector<Vector2d>;
using People = std::vector<MovingPerson>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

DrawnFloor emptyRoom() {
  DrawnFloor floor;
  floor.low = {-5.0, -5.0};
  floor.high = {5.0, 5.0};
  return floor;
}

LineWalker walker(const Vector2d& from, const Vector2d& to) {
  LineWalker out;
  out.from = from;
  out.to = to;
  out.person.position = from;
  return out;
}

bool drive(DriveLoop& loop, const Path& path, double limit_s) {
  while (loop.time_s() < limit_s) {
    if (loop.step(path).status == DriveStatus::kArrived) return true;
  }
  return false;
}

TEST(LocalPlanner, DrivesStraightAtFullSpeedAndStopsAtTheGoal) {
  DriveLoop loop(emptyRoom(), {{0, 0}, 0});
  ASSERT_TRUE(drive(loop, {{0, 0}, {3, 0}}, 20.0));
  for (int i = 0; i < 10; ++i) loop.step({{0, 0}, {3, 0}});
  EXPECT_NEAR(loop.state().pose.position.x(), 3.0, 0.1);
  EXPECT_NEAR(loop.state().pose.position.y(), 0.0, 0.02);
  EXPECT_NEAR(loop.state().speed.forward_mps, 0.0, 1e-9);
  EXPECT_GT(loop.movingSpeed(), 0.26);
  EXPECT_EQ(loop.turnReversals(), 0);
}

/// How far it is from somebody when it stands, if they come up to it as soon as it has decided.
double roomWhenItStands(const LocalPlannerParams& params, double mps, double room_m,
                        double comes_mps, double most_mps) {
  const double brakes_s = mps / params.limits.max_braking_mps2;
  double left_m = room_m - mps * (params.reacts_s + 0.5 * brakes_s);
  constexpr double kStep_s = 1e-4;
  for (double t = 0.0; t < params.reacts_s + brakes_s; t += kStep_s) {
    comes_mps = std::min(comes_mps + kStep_s * kWalkersGain_mps2, most_mps);
    left_m -= kStep_s * comes_mps;
  }
  return left_m;
}

TEST(LocalPlanner, StandsWhenWhoStandsWalksOrHidesAheadCouldReachIt) {
  LocalPlannerParams params;
  params.limits.max_braking_mps2 = 0.5;
  const Path ahead{{0, 0}, {3, 0}};
  const auto open = [](const Vector2d&) { return 10.0; };
  for (const double comes_mps : {-0.4, 0.0, 0.4, params.appears_mps}) {
    const bool hides = comes_mps == params.appears_mps;
    int slowed = 0;
    for (double room_m = 0.4; room_m < 1.6; room_m += 0.05) {
      MovingPerson person;
      person.position.x() = params.limits.radius_m + person.radius_m + room_m;
      person.velocity.x() = 0.2 - comes_mps;
      person.gait_mps = 0.2;
      LocalPlanner planner(params);
      if (hides) planner.expect({person.position});
      const LocalPlan plan = planner.step({}, {}, ahead, open, hides ? People{} : People{person});
      const double mps = plan.command.forward_mps;
      const double room_then_m =
          roomWhenItStands(params, mps, room_m, comes_mps, hides ? comes_mps : params.walks_mps);
      const bool may_creep = mps <= params.least_speed_mps && (hides || comes_mps <= 0.0);
      EXPECT_GE(room_then_m, may_creep ? -0.1 : -1e-3) << room_m;
      if (mps < 0.99 * params.limits.max_speed_mps) ++slowed;
      EXPECT_TRUE(mps > 0.0 || !hides) << "it goes there";
    }
    EXPECT_GT(slowed, 1) << comes_mps;
    EXPECT_LT(slowed, 24) << comes_mps;
  }
}

// Bug: who stood aside was in nobody's way, though the robot turned to them as it drove.
TEST(LocalPlanner, StandsWhenWhoStandsAsideReachesItThoughItTurnsToThem) {
  LocalPlannerParams params;
  params.limits.max_braking_mps2 = 0.5;
  params.reacts_s = 0.4;
  const auto open = [](const Vector2d&) { return 10.0; };
  int turning = 0;
  for (double bearing = 1.0; bearing < 2.2; bearing += 0.1) {
    for (double room_m = 0.2; room_m < 0.8; room_m += 0.05) {
      const Vector2d way(std::cos(bearing), std::sin(bearing));
      MovingPerson person;
      person.position = (params.limits.radius_m + person.radius_m + room_m) * way;
      LocalPlanner planner(params);
      const Path around{{0, 0}, {0.3, 0}, {0.3, 3}};
      const LocalPlan plan = planner.step({}, {0.3, 0.0}, around, open, {person});
      DriveState state{{}, {plan.command.forward_mps, plan.command.turn_radps}};
      const double brakes_s = plan.command.forward_mps / params.limits.max_braking_mps2;
      double comes_m = 0.0, towards_mps = 0.0;
      constexpr double kStep_s = 0.01;
      for (double t = 0.0; t < params.reacts_s + brakes_s; t += kStep_s) {
        const bool brakes = t >= params.reacts_s;
        state = driven(params.limits, state, brakes ? VelocityCommand{} : plan.command, kStep_s);
        comes_m += kStep_s * std::min(t * kWalkersGain_mps2, params.walks_mps);
        const Vector2d heading(std::cos(state.pose.yaw_rad), std::sin(state.pose.yaw_rad));
        towards_mps = plan.command.forward_mps * heading.dot(way);
      }
      const double gone_m = std::max(state.pose.position.dot(way), 0.0);
      EXPECT_TRUE(comes_m + gone_m <= room_m + 0.01 || towards_mps <= 0.011)
          << bearing << " " << room_m << ": " << plan.command.forward_mps << " "
          << plan.command.turn_radps;
      turning += plan.command.forward_mps > 0.05 && plan.command.turn_radps > 0.2 ? 1 : 0;
    }
  }
  EXPECT_GT(turning, 5);
}

TEST(LocalPlanner, TurnsOnTheSpotToAPathBehindIt) {
  DriveLoop loop(emptyRoom(), {{0, 0}, 3.0});
  EXPECT_EQ(loop.step({{0, 0}, {2, 0}}).status, DriveStatus::kTurning);
  ASSERT_TRUE(drive(loop, {{0, 0}, {2, 0}}, 15.0));
  EXPECT_LE(loop.turnReversals(), 1);
}

TEST(LocalPlanner, PassesDoorwaysAtSpeed) {
  for (const double width : {0.8, 0.9}) {
    for (const double y : {0.6, 2.0, 3.4}) {
      for (const int late : {0, 1}) {
        const DrawnFloor floor = test::roomWithDoorway(width);
        const Path path = test::wayOn(floor, {1.0, y}, {5.0, 4.0 - y}, 0.26);
        DriveLoop loop(floor, {{1.0, y}, 0.0}, {}, late);
        ASSERT_TRUE(drive(loop, path, 40.0)) << width << " " << y << " " << late;
        EXPECT_GT(loop.leastGap(), 0.04);
        EXPECT_GE(loop.movingSpeed(), 0.24) << width << " " << y << " " << late;
        EXPECT_LE(loop.turnReversals(), 4);
      }
    }
  }
}

TEST(LocalPlanner, TakesALongBodyThroughDoorwaysThatAreNarrowerThanItIsLong) {
  LocalPlannerParams params;
  params.limits = withBodyAround({{0.35, 0.2}, {-0.35, 0.2}, {-0.35, -0.2}, {0.35, -0.2}}, {});
  for (const double width : {0.7, 0.8, 0.9}) {
    for (const double y : {0.8, 2.0, 3.2}) {
      const DrawnFloor floor = test::roomWithDoorway(width);
      const Path path = test::wayOn(floor, {1.0, y}, {5.0, 4.0 - y}, params.limits.radius_m);
      DriveLoop loop(floor, {{1.0, y}, 0.0}, params);
      ASSERT_TRUE(drive(loop, path, 60.0)) << width << " " << y;
      EXPECT_GT(loop.leastGap(), 0.035) << width << " " << y;
    }
  }
}

TEST(LocalPlanner, StopsWithinItsStoppingDistanceWhenSomethingAppears) {
  const Path path = {{0, 0}, {4, 0}};
  DriveLoop loop(emptyRoom(), {{0, 0}, 0});
  while (loop.time_s() < 4.0) loop.step(path);
  const double before = loop.state().pose.position.x(), speed = loop.state().speed.forward_mps;
  ASSERT_NEAR(speed, 0.3, 0.01);
  loop.floor.boxes.push_back({{before + 0.26 + 0.075, -4.9}, {before + 1.0, 4.9}});
  loop.step(path);
  EXPECT_LE(loop.plan().command.forward_mps, 0.0);
  for (int i = 0; i < 20; ++i) loop.step(path);
  EXPECT_LE(loop.state().pose.position.x() - before, stoppingDistance({}, speed, 0.0) + 0.01);
  EXPECT_GT(loop.leastGap(), 0.0);
  EXPECT_NEAR(loop.state().speed.forward_mps, 0.0, 1e-9);
}

TEST(LocalPlanner, SaysThatAWallIsInTheWay) {
  DrawnFloor floor = emptyRoom();
  floor.boxes.push_back({{1.0, -4.9}, {1.1, 4.9}});
  DriveLoop loop(floor, {{0, 0}, 0});
  for (int i = 0; i < 150; ++i) loop.step({{0, 0}, {4, 0}});
  EXPECT_EQ(loop.plan().status, DriveStatus::kBlocked);
  EXPECT_EQ(loop.plan().reason, DriveReason::kObstacleInWay);
  EXPECT_GT(loop.plan().blocked_s, 2.0);
  EXPECT_GT(loop.leastGap(), 0.03);
}

TEST(LocalPlanner, GetsAwayFromAWallThatItStandsTooNearToAndFacesALittle) {
  DrawnFloor floor = emptyRoom();
  floor.boxes.push_back({{-4.9, -1.0}, {1.0, -0.26 - 0.03}});  // less than the margin
  DriveLoop loop(floor, {{0, 0}, -0.2});
  ASSERT_TRUE(drive(loop, {{0, 0}, {0.6, 0.12}, {3, 0.3}}, 20.0));
  EXPECT_GT(loop.leastGap(), 0.02);
}

TEST(LocalPlanner, StopsForAWalkerWhoComesHeadOn) {
  DrawnFloor floor;  // A corridor with no room to pass.
  floor.low = {-5.0, -0.5};
  floor.high = {5.0, 0.5};
  DriveLoop loop(floor, {{0, 0}, 0});
  loop.walkers = {walker({4.5, 0}, {-4.0, 0})};
  double greatest = 0.0;
  bool gave_way = false;
  while (loop.time_s() < 15.0) {
    loop.step({{0, 0}, {4, 0}});
    const double room = loop.plan().people_gap_m;
    const bool comes = loop.walkers[0].person.velocity.x() < -0.5;
    if (comes && room < 0.45) greatest = std::max(greatest, loop.state().speed.forward_mps);
    gave_way = gave_way || loop.plan().reason == DriveReason::kGivesWay;
  }
  EXPECT_GT(loop.leastPeopleGap(), 0.05);
  EXPECT_LT(greatest, 0.1);
  EXPECT_TRUE(gave_way);
}

TEST(LocalPlanner, LetsACrossingWalkerPassAndGoesOn) {
  DriveLoop loop(emptyRoom(), {{-2, 0}, 0});
  loop.walkers = {walker({0, -3}, {0, 3})};
  ASSERT_TRUE(drive(loop, {{-2, 0}, {2, 0}}, 40.0));
  EXPECT_GT(loop.leastPeopleGap(), 0.1);
}

TEST(LocalPlanner, DrivesAroundSomebodyWhoStands) {
  DriveLoop loop(emptyRoom(), {{-2, 0}, 0});
  loop.walkers = {walker({0, 0.1}, {0, 0.1})};
  ASSERT_TRUE(drive(loop, {{-2, 0}, {2, 0}}, 40.0));
  EXPECT_GT(loop.leastPeopleGap(), 0.08);
  EXPECT_LE(loop.turnReversals(), 6);
}

TEST(LocalPlanner, BacksOffOnlyOntoKnownFreeFloor) {
  LocalPlanner planner;
  const std::vector<MovingPerson> people = {{{0.9, 0.0}, {-1.0, 0.0}, 0.25}};
  const auto open = [](const Vector2d&) { return 2.0; };
  EXPECT_LT(planner.step({}, {}, {}, open, people).command.forward_mps, 0.0);
  planner.reset();
  const auto unknown_behind = [](const Vector2d& p) { return p.x() < -1e-3 ? kNaN : 0.3; };
  EXPECT_EQ(planner.step({}, {}, {}, unknown_behind, people).command.forward_mps, 0.0);
}

// Bug: as long as somebody touched it all futures were the same to it, and it turned on the spot.
TEST(LocalPlanner, DrivesAwayFromWhoeverTouchesIt) {
  const auto passage = [](const Vector2d& p) { return 0.45 - std::abs(p.y()); };
  for (const double at_m : {-0.45, -0.48}) {
    LocalPlanner planner;
    DriveState robot;
    const std::vector<MovingPerson> people = {{{at_m, -0.1}, {0.0, 0.0}, 0.25}};
    for (int i = 0; i < 40; ++i) {
      const LocalPlan& plan =
          planner.step(robot.pose, robot.speed, {{0.0, 0.0}, {3.0, 0.0}}, passage, people);
      robot = driven(planner.params().limits, robot, plan.command, 0.1);
    }
    EXPECT_GT(robot.pose.position.x(), 0.5) << at_m;
  }
}

TEST(LocalPlanner, TurnsToTheFaceWhenThereIsNowhereToGo) {
  DriveLoop loop(emptyRoom(), {{0, 0}, 0});
  EXPECT_EQ(loop.step({}, Vector2d(0, 2)).status, DriveStatus::kTurning);
  for (int i = 0; i < 60; ++i) loop.step({}, Vector2d(0, 2));
  EXPECT_NEAR(loop.state().pose.yaw_rad, M_PI / 2, 0.1);
  EXPECT_EQ(loop.plan().status, DriveStatus::kStopped);
  EXPECT_NEAR(loop.state().pose.position.norm(), 0.0, 1e-9);
}

TEST(LocalPlanner, StopsAndSaysWhyOnBadInput) {
  LocalPlanner planner;
  const auto open = [](const Vector2d&) { return 2.0; };
  const auto unknown = [](const Vector2d&) { return kNaN; };
  const Path path = {{0, 0}, {2, 0}};
  const auto reason = [&](const LocalPlan& plan) {
    EXPECT_EQ(plan.command.forward_mps, 0.0);
    EXPECT_EQ(plan.command.turn_radps, 0.0);
    EXPECT_EQ(plan.status, DriveStatus::kStopped);
    return plan.reason;
  };
  const VelocityCommand fast{0.3, 0.0};
  EXPECT_EQ(reason(planner.step({}, fast, {}, open, {})), DriveReason::kNoPath);
  EXPECT_EQ(reason(planner.step({}, fast, {{0, 0}, {kNaN, 0}}, open, {})), DriveReason::kBadPath);
  EXPECT_EQ(reason(planner.step({{kNaN, 0}, 0}, fast, path, open, {})), DriveReason::kBadPose);
  EXPECT_EQ(reason(planner.step({}, {kNaN, 0}, path, open, {})), DriveReason::kBadPose);
  EXPECT_EQ(reason(planner.step({}, fast, path, unknown, {})), DriveReason::kNoClearance);
  EXPECT_EQ(reason(planner.step({}, fast, path, open, {{{1, 0}, {kNaN, 0}, 0.2}})),
            DriveReason::kBadPeople);
  // A face that isn't finite is none; a path of one point is a goal.
  EXPECT_EQ(planner.step({}, {}, {{2, 0}}, open, {}, Vector2d(kNaN, 0)).reason,
            DriveReason::kOnTheWay);
}

TEST(LocalPlanner, RefusesParametersThatMakeNoSense) {
  LocalPlannerParams params;
  params.limits.max_speed_mps = 0.0;
  EXPECT_THROW(LocalPlanner{params}, std::invalid_argument);
  params = {};
  params.horizon_s = kNaN;
  EXPECT_THROW(LocalPlanner{params}, std::invalid_argument);
  params = {};
  params.margin_m = -0.1;
  EXPECT_THROW(LocalPlanner{params}, std::invalid_argument);
}

TEST(LocalPlanner, AllocatesNothingOnceWarmAndRepeatsItself) {
  const DrawnFloor floor = test::roomWithDoorway(0.8);
  const Path path = {{1, 2}, {5, 2}};
  const std::vector<MovingPerson> people = {{{2.0, 2.5}, {-1.0, 0.0}, 0.25}};
  const auto clearance = [&](const Vector2d& p) { return floor.clearance(p); };
  LocalPlanner a, b;
  for (int i = 0; i < 3; ++i) {
    a.step({{1, 2}, 0}, {0.2, 0}, path, clearance, people);
    b.step({{1, 2}, 0}, {0.2, 0}, path, clearance, people);
  }
  const long before = test::allocations();
  const LocalPlan plan = a.step({{1.1, 2}, 0.3}, {0.25, 0.1}, path, clearance, people);
  EXPECT_EQ(test::allocations(), before);
  const LocalPlan same = b.step({{1.1, 2}, 0.3}, {0.25, 0.1}, path, clearance, people);
  EXPECT_EQ(plan.command.forward_mps, same.command.forward_mps);
  EXPECT_EQ(plan.command.turn_radps, same.command.turn_radps);
  EXPECT_EQ(plan.costs, same.costs);
}

}  // namespace
}  // namespace heel
