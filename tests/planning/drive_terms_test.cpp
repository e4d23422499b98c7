// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/drive_terms.hpp>

#include <gtest/gtest.h>

#include <cmath>
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
  EXPECT_NEAR(state.pose.position.x(), stoppingDistance(limits, 0.3, 0.0), 1e-9);  // 0.09 m
  EXPECT_NEAR(speedToStopWithin(limits, 0.09), 0.3, 1e-12);
}

TEST(Drive, RefusesLimitsThatAreNotPositive) {
  DriveLimits limits;
  limits.period_s = std::nan("");
  EXPECT_THROW(checkLimits(limits), std::invalid_argument);
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
  EXPECT_NEAR(roomToPeople(people, {0, 0}, 0.26, 0.0), 1.49, 1e-12);  // 2 - 0.25 - 0.26
  EXPECT_NEAR(roomToPeople(people, {0, 0}, 0.26, 1.0), 0.49, 1e-12);
  EXPECT_NEAR(roomToPeople(people, {0, 0}, 0.26, 4.0), 1.49, 1e-12);  // Has gone by.
  EXPECT_NEAR(roomToWays(people, {0, 0}, 0.26, 4.0), -0.51, 1e-12);   // But went through here.
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
