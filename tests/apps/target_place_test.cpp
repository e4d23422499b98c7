// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/target_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kFar = 9.0;  // To the nearest thing on the map.

/// A laser that looks all around in an empty hall, with somebody's legs here and there, at 10 Hz;
/// and a camera which sees or does not see the target.
class TargetPlaceTest : public testing::Test {
 protected:
  void step() {
    LaserScan scan;
    scan.first_rad = -M_PI;
    scan.step_rad = M_PI / 360.0;
    scan.ranges_m.assign(720, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const Vector2d along(std::cos(scan.angle(i)), std::sin(scan.angle(i)));
      for (const Vector2d& person : legs) {
        const double off = std::abs(along.x() * person.y() - along.y() * person.x());
        if (off < 0.12 && along.dot(person) > 0.0) {
          scan.ranges_m[i] = std::min(scan.ranges_m[i], static_cast<float>(person.norm()));
        }
      }
    }
    stamp_s += 0.1;
    around.step(stamp_s, scan, {}, [](const Vector2d&) { return kFar; });
    TargetEstimate seen;
    seen.status = camera_sees ? TargetStatus::kFollowed : TargetStatus::kLost;
    seen.confidence = confidence;
    seen.motion.mean.head<2>() = legs.empty() ? Vector2d(0.0, 0.0) : legs[0];
    place.step(
        seen, around, [this](const Vector2d&) { return in_view; },
        [this](const Vector2d&) { return unlike; }, 0.1);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  void walk(const Vector2d& velocity, int count) {
    for (int i = 0; i < count; ++i) {
      legs[0] += 0.1 * velocity;
      step();
    }
  }

  /// Whether they are believed to be anywhere, so long after the camera's last look.
  bool isBelievedAfter(double unseen_s) {
    steps(5);
    camera_sees = false;
    steps(static_cast<int>(std::lround(unseen_s * 10.0)));
    return place.now().has_value();
  }
  /// Neither sensor has them for two seconds; then somebody walks where they can be.
  void loseAndSeeSomebodyWalk() {
    steps(5);
    camera_sees = false;
    legs.clear();
    steps(20);
    EXPECT_FALSE(place.suspect());
    legs = {{2.0, 1.0}};
    walk({0.0, 0.6}, 15);
    ASSERT_TRUE(place.suspect());
  }

  std::vector<Vector2d> legs{{2.0, 0.0}};
  bool camera_sees = true;
  bool in_view = false;
  bool unlike = false;
  double confidence = 0.95;
  double stamp_s = 20.0;
  PeopleAround around;
  TargetPlace place;
};

TEST_F(TargetPlaceTest, IsWhereTheCameraSeesThem) {
  steps(5);
  ASSERT_TRUE(place.now());
  EXPECT_EQ(place.now()->position, legs[0]);
  EXPECT_EQ(place.unseen_s(), 0.0);
}

TEST_F(TargetPlaceTest, GoesOnWithTheLegsOutOfTheCamerasView) {
  steps(5);
  camera_sees = false;
  walk({-0.6, 0.6}, 50);  // Past the robot, and behind it.
  ASSERT_TRUE(place.now());
  EXPECT_LT((place.now()->position - legs[0]).norm(), 0.3);
  EXPECT_LT((place.now()->velocity - Vector2d(-0.6, 0.6)).norm(), 0.2);
}

TEST_F(TargetPlaceTest, BelievesLegsForALimitedTime) {
  EXPECT_TRUE(isBelievedAfter(TargetPlaceParams().legs_alone_s - 0.2));
  steps(4);
  EXPECT_FALSE(place.now());
  camera_sees = true;
  step();
  EXPECT_TRUE(place.now()) << "and anew when the camera has seen whose they are";
  camera_sees = false;
  steps(20);
  EXPECT_TRUE(place.now());
}

TEST_F(TargetPlaceTest, DoubtsLegsWhereTheCameraSeesNobody) {
  in_view = true;
  EXPECT_FALSE(isBelievedAfter(TargetPlaceParams().legs_in_view_s + 0.2));
}

TEST_F(TargetPlaceTest, DoubtsLegsOfWhoTheCameraSeesToBeSomebodyElse) {
  unlike = true;
  EXPECT_FALSE(isBelievedAfter(TargetPlaceParams().legs_unlike_s + 0.2));
}

TEST_F(TargetPlaceTest, KnowsOthersFromWhenTheTargetWasSeen) {
  legs.push_back({0.0, 3.0});
  steps(8);
  ASSERT_EQ(place.others().size(), 1U);
  camera_sees = false;
  legs.erase(legs.begin());
  steps(20);
  ASSERT_EQ(place.others().size(), 1U) << "whom the laser has not lost since";
  EXPECT_LT((place.others()[0] - legs[0]).norm(), 0.3);
  legs.push_back({-2.0, 0.0});
  steps(10);
  EXPECT_EQ(place.others().size(), 1U) << "but not who came later";
}

TEST_F(TargetPlaceTest, KnowsNoOthersOnceTheyHaveBeenBesideTheTarget) {
  legs.push_back({2.0, 2.0});
  steps(8);
  ASSERT_EQ(place.others().size(), 1U);
  camera_sees = false;
  walk({0.0, 0.5}, 30);
  EXPECT_TRUE(place.others().empty());
}

TEST_F(TargetPlaceTest, DoubtsLegsBesideOthers) {
  legs.push_back({2.0, 0.55});
  EXPECT_FALSE(isBelievedAfter(TargetPlaceParams().legs_mixed_s + 0.2));
}

TEST_F(TargetPlaceTest, ExpectsALostPersonToWalkOnForAWhile) {
  steps(5);
  walk({0.0, 0.5}, 20);
  const Vector2d last = legs[0];
  legs.clear();
  camera_sees = false;
  steps(12);
  ASSERT_FALSE(place.now());
  EXPECT_LT((place.last().position - last).norm(), 0.5);
  const Vector2d on = place.expected().position - place.last().position;
  EXPECT_NEAR(on.y(), place.unseen_s() * place.last().velocity.y(), 1e-9);
  steps(100);
  const Vector2d end = place.expected().position;
  steps(10);
  EXPECT_EQ(place.expected().position, end);
}

TEST_F(TargetPlaceTest, SuspectsWhoWalksWhereTheLostCanBe) {
  loseAndSeeSomebodyWalk();
  EXPECT_LT((place.suspect()->position - legs[0]).norm(), 0.3);
  EXPECT_EQ(place.expected().position, place.suspect()->position);
}

TEST_F(TargetPlaceTest, SuspectsNobodyTwiceWhomTheCameraDidNotRecognize) {
  loseAndSeeSomebodyWalk();
  in_view = true;
  steps(5);
  EXPECT_TRUE(place.suspect()) << "a look takes its time";
  steps(11);  // 1.6 s
  EXPECT_FALSE(place.suspect());
  in_view = false;
  walk({0.0, 0.6}, 20);
  walk({0.0, -0.6}, 20);
  EXPECT_FALSE(place.suspect());
  camera_sees = true;
  step();
  camera_sees = false;
  unlike = true;
  steps(20);
  ASSERT_FALSE(place.now());
  EXPECT_TRUE(place.suspect()) << "another loss, another suspicion";
}

TEST_F(TargetPlaceTest, SuspectsNobodyForLongWhomTheCameraCannotSee) {
  loseAndSeeSomebodyWalk();
  steps(40);
  EXPECT_FALSE(place.suspect());
}

TEST_F(TargetPlaceTest, BelievesNoLegsWhereTheCameraLastSawSomebodyElse) {
  steps(5);
  unlike = true;
  confidence = 0.2;
  step();
  EXPECT_TRUE(place.now());
  camera_sees = false;
  unlike = false;  // out of its view
  step();
  EXPECT_FALSE(place.now());
}

TEST_F(TargetPlaceTest, SuspectsNobodyWhoIsTooFarToBeThem) {
  legs = {{-4.0, 0.0}};
  steps(5);
  camera_sees = false;
  legs.clear();
  steps(10);
  legs = {{4.0, 0.0}};
  walk({0.0, 0.6}, 15);
  ASSERT_FALSE(around.people().empty());
  EXPECT_FALSE(place.suspect());
}

}  // namespace
}  // namespace heel
