// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/drive_terms.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

TEST(Drive, SpeedsUpAndBrakesWithinItsLimits) {
  const DriveLimits limits;
  const DriveState faster = driven(limits, {}, {0.3, 1.0}, 0.1);
  EXPECT_NEAR(faster.speed.forward_mps, 0.05, 1e-12);  // 0.5 m/s2 * 0.1 s
  EXPECT_NEAR(faster.speed.turn_radps, 0.2, 1e-12);    // 2 rad/s2 * 0.1 s
  EXPECT_NEAR(faster.pose.yaw_rad, 0.01, 1e-12);       // mean of 0 and 0.2, for 0.1 s
  DriveState state{{}, {0.3, 0.0}};
  while (state.speed.forward_mps > 0.0) state = driven(limits, state, {}, 0.1);
  EXPECT_NEAR(state.pose.position.x(), stoppingDistance(limits, 0.3, 0.0), 1e-9);  // 0.045 m
  EXPECT_NEAR(speedToStopWithin(limits, 0.045), 0.3, 1e-12);
}

TEST(Drive, BrakesToAStandBeforeItGoesTheOtherWay) {
  const DriveLimits limits;  // 1 m/s2 to a stand, 0.5 m/s2 from it
  EXPECT_NEAR(speedAfter(limits, {0.3, 0.0}, {0.1, 0.0}, 0.1).forward_mps, 0.2, 1e-12);
  EXPECT_NEAR(speedAfter(limits, {-0.1, 0.0}, {0.3, 0.0}, 0.3).forward_mps, 0.1, 1e-12);
  EXPECT_NEAR(speedAfter(limits, {0.1, 0.0}, {-0.3, 0.0}, 9.0).forward_mps, -0.3, 1e-12);
  EXPECT_EQ(speedAfter(limits, {0.3, 0.0}, {0.3, 0.0}, 0.1).forward_mps, 0.3);
}

TEST(Drive, RefusesLimitsThatAreNotPositive) {
  DriveLimits limits;
  limits.period_s = std::nan("");
  EXPECT_THROW(checkLimits(limits), std::invalid_argument);
  limits = {};
  limits.back_m = 0.1;
  EXPECT_THROW(checkLimits(limits), std::invalid_argument) << "before its front";
}

DriveLimits longBody() {
  return withBodyAround({{0.35, 0.2}, {-0.35, 0.2}, {-0.35, -0.2}, {0.35, -0.2}}, {});
}

TEST(DriveBody, HoldsItsCornersAndIsNarrow) {
  const DriveLimits body = longBody();
  for (const Vector2d& corner : {Vector2d(0.35, 0.2), Vector2d(-0.35, -0.2)}) {
    EXPECT_LE((corner - axisOf(body, {}).nearest(corner)).norm(), body.radius_m + 1e-9);
  }
  EXPECT_LT(body.radius_m, 0.22);
  EXPECT_NEAR(body.front_m, -body.back_m, 1e-9);
  const DriveLimits round = withBodyAround({{0.4, 0.1}, {0.2, 0.1}, {0.3, 0.2}, {0.3, 0.0}}, {});
  EXPECT_EQ(round.front_m, round.back_m) << "whose middle is ahead";
}

TEST(DriveBody, ItsRoomIsThatAroundItsAxis) {
  const DriveLimits body = longBody();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const FloorPose pose{{any(random), any(random)}, 4.0 * any(random)};
    const Vector2d post(2.0 * any(random), 2.0 * any(random));
    const auto clearance = [&](const Vector2d& p) { return (p - post).norm(); };
    const double room_m = (post - axisOf(body, pose).nearest(post)).norm() - body.radius_m;
    if (room_m < 0.0) {
      EXPECT_LT(roomAround(body, pose, clearance), 0.0);
      continue;
    }
    EXPECT_LE(roomAround(body, pose, clearance), room_m + 1e-9);
    EXPECT_GE(roomAround(body, pose, clearance), room_m - 0.033 * body.radius_m);
  }
  EXPECT_TRUE(std::isnan(
      roomAround(body, {}, [](const Vector2d& p) { return p.x() > 0.1 ? std::nan("") : 1.0; })));
}

TEST(FloorLine, DistanceIsThatOfTheNearestPoints) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto place = [&] { return Vector2d(any(random), any(random)); };
  for (int i = 0; i < 300; ++i) {
    const FloorLine a{place(), place()}, b{place(), place()};
    double least = 10.0;
    for (int k = 0; k <= 400; ++k) {
      const Vector2d p = a.from + k / 400.0 * (a.to - a.from);
      least = std::min(least, (p - b.nearest(p)).norm());
    }
    EXPECT_NEAR(distanceBetween(a, b), least, 0.004);
    EXPECT_DOUBLE_EQ(distanceBetween(a, {b.from, b.from}), (b.from - a.nearest(b.from)).norm());
  }
}

TEST(PathAhead, BeginsAtTheNearestPointAndEndsWithThePath) {
  PathAhead path;
  path.take({{0, 0}, {1, 0}, {1, 1}}, {0.5, 0.2}, 5.0);
  EXPECT_TRUE(path.points().front().isApprox(Vector2d(0.5, 0.0)));
  EXPECT_TRUE(path.points().back().isApprox(Vector2d(1.0, 1.0)));
  EXPECT_TRUE(path.endsAtGoal());
  const auto place = path.locate({0.75, 0.1});
  EXPECT_NEAR(place.off_m, 0.1, 1e-6);
  EXPECT_NEAR(place.left_m, 1.25, PathAhead::kSpacing_m);
  EXPECT_NEAR(place.direction_rad, 0.0, 1e-9);
  path.take({{0, 0}, {9, 0}}, {1.0, 0.0}, 2.0);
  EXPECT_FALSE(path.endsAtGoal());
  EXPECT_NEAR(path.points().back().x(), 3.0, 1e-9);
}

TEST(PathAhead, TakesAPathOfOnePointAndOneThatStandsStill) {
  PathAhead path;
  path.take({{2, 0}}, {0, 0}, 1.0);
  EXPECT_EQ(path.points().size(), 1U);
  path.take({{2, 0}, {2, 0}, {2, 0}}, {0, 0}, 1.0);
  EXPECT_TRUE(path.endsAtGoal());
  EXPECT_TRUE(path.points().back().isApprox(Vector2d(2.0, 0.0)));
}

TEST(RoomToPeople, IsBetweenTheEdgesOfBodies) {
  const std::vector<MovingPerson> people = {{{2.0, 0.0}, {-1.0, 0.0}, 0.25}};
  EXPECT_NEAR(roomToPeople(people, {}, {}, 0.0), 1.49, 1e-12);  // 2 - 0.25 - 0.26
  EXPECT_NEAR(roomToPeople(people, {}, {}, 1.0), 0.49, 1e-12);
  EXPECT_NEAR(roomToPeople(people, {}, {}, 4.0), 1.49, 1e-12);  // Has gone by.
  EXPECT_NEAR(roomToWays(people, {}, {}, 4.0), -0.51, 1e-12);   // But went through here.
}

class DriveTerms : public testing::Test {
 protected:
  DriveTerms() {
    futures_.steps = 40;
    path_.take({{0, 0}, {9, 0}}, {0, 0}, 3.0);
    scene_.path = &path_;
    scene_.start = path_.locate({0, 0});
    scene_.people = &people_;
  }
  DriveScores costs(const VelocityCommand& command, double gap_m = 1.0) {
    futures_.clear();
    addHeld({}, scene_.now, command, futures_);
    const std::vector<double> gaps(futures_.steps, gap_m);
    return driveCosts({}, {}, scene_, {futures_.row(0), gaps.data(), 40, 40, command});
  }
  static double of(const DriveScores& costs, DriveTerm term) {
    return costs[static_cast<std::size_t>(term)];
  }

  Trajectories futures_;
  PathAhead path_;
  std::vector<MovingPerson> people_;
  DriveScene scene_;
};

TEST_F(DriveTerms, ProgressIsNothingMissedAtFullSpeedAndAllWhenStanding) {
  scene_.now.speed = {0.3, 0.0};
  EXPECT_NEAR(of(costs({0.3, 0.0}), DriveTerm::kProgress), 0.0, 0.02);
  scene_.now.speed = {};
  EXPECT_NEAR(of(costs({0.0, 0.0}), DriveTerm::kProgress), 1.0, 1e-9);
}

TEST_F(DriveTerms, ClearanceIsTheSquareOfTheLackOfRoom) {
  EXPECT_EQ(of(costs({0.3, 0.0}, 0.3), DriveTerm::kClearance), 0.0);
  EXPECT_NEAR(of(costs({0.3, 0.0}, 0.125), DriveTerm::kClearance), 0.25, 1e-9);  // (1 - 1/2)^2
}

TEST_F(DriveTerms, ViewIsTheAngleOutsideThePicture) {
  scene_.face = Vector2d(0.0, 5.0);
  EXPECT_NEAR(of(costs({0.0, 0.0}), DriveTerm::kView), M_PI / 2 - 0.4, 1e-9);
  scene_.face = Vector2d(5.0, 1.0);
  EXPECT_EQ(of(costs({0.0, 0.0}), DriveTerm::kView), 0.0);
}

TEST_F(DriveTerms, SmoothIsTheChangeOfTheCommand) {
  scene_.last = {0.15, -0.5};
  EXPECT_NEAR(of(costs({0.3, 0.5}), DriveTerm::kSmooth), 0.5 + 1.0, 1e-9);
}

TEST_F(DriveTerms, PeopleCostMoreTheSoonerTheyTouch) {
  people_ = {{{1.2, 0.0}, {-1.0, 0.0}, 0.25}};
  const double on = of(costs({0.3, 0.0}), DriveTerm::kPeople);
  const double stay = of(costs({0.0, 0.0}), DriveTerm::kPeople);
  const double back = of(costs({-0.15, 0.0}), DriveTerm::kPeople);
  EXPECT_GT(on, stay);
  EXPECT_GT(stay, back);
}

TEST_F(DriveTerms, PathAndHeadingAreFreeOnThePathAndWithoutOne) {
  EXPECT_NEAR(of(costs({0.3, 0.0}), DriveTerm::kPath), 0.0, 1e-9);
  EXPECT_NEAR(of(costs({0.3, 0.0}), DriveTerm::kHeading), 0.0, 1e-9);
  EXPECT_GT(of(costs({0.3, 0.5}), DriveTerm::kPath), 0.1);
  EXPECT_GT(of(costs({0.3, 0.5}), DriveTerm::kHeading), 0.1);
  path_.clear();
  EXPECT_EQ(of(costs({0.3, 0.5}), DriveTerm::kPath), 0.0);
}

}  // namespace
}  // namespace heel
