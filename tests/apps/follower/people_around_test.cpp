// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/follower/colored_stage.hpp"
#include "tests/support/target_scene.hpp"
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/people_around.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace heel {
namespace {

using test::ColoredStage;
using test::legsAt;

Perception perceptionOfStage() {
  CameraSetup camera;
  camera.sensor = SensorKind::kRgbd;
  camera.camera.left = ColoredStage().camera;
  camera.T_base_camera = ColoredStage::T_base_camera();
  return {camera, AppearanceModel({}, test::paintPerson(), test::paintRoom()), {}};
}

// Bug: legs that stood in a corner, a person as likely as not, were passed as closely as a thing,
// and the robot grazed an arm.
TEST(PeopleAround, WhoMayBeAPersonIsAvoidedAsOneUntilTheyAreSurelyNone) {
  Perception perception = perceptionOfStage();
  ColoredStage stage;
  stage.part(2.5, 0.4, 0.2, 0.0, 0.8, {40, 150, 40});  // a chair
  const Eigen::Vector2d legs_m(-2.0, 1.0);             // behind the robot
  const LaserBodies legs = legsAt({legs_m, {2.5, 0.4}});
  const RecentSight sight({}, 8.0);
  PeopleAround people{FollowerParams()};
  Situation now;
  now.unseen_s = 1e3;  // The target is far away.
  for (int i = 0; i < 30; ++i) {
    perception.step(stage.frame(0.1 * i), {}, &legs);
    people.step(0.1 * i, perception, sight, {}, now);
  }
  int unsure = 0, things = 0;
  for (const Track& track : perception.tracks()) {
    const double thing = perception.identity().probabilities(track.id)[kThing];
    unsure += thing > 0.2 && thing < 0.95 ? 1 : 0;
    things += thing > 0.95 ? 1 : 0;
  }
  ASSERT_EQ(unsure, 1) << "the legs";
  ASSERT_EQ(things, 1) << "the chair";
  ASSERT_EQ(now.people.size(), 1U);
  EXPECT_LT((now.people[0].position - legs_m).norm(), 0.3);
}

// Bug: a person who stood in a corridor became more and more a thing, and at 80 % was touched.
TEST(PeopleAround, WhoStandsForLongIsStillAvoided) {
  Perception perception = perceptionOfStage();
  const Eigen::Vector2d legs_m(-2.0, 1.0);  // behind the robot
  const LaserBodies legs = legsAt({legs_m});
  const RecentSight sight({}, 8.0);
  PeopleAround people{FollowerParams()};
  Situation now;
  now.unseen_s = 1e3;
  double thing = 0.0;
  for (int i = 0; i < 2000 && thing < 0.85; ++i) {
    perception.step(ColoredStage().frame(0.1 * i), {}, &legs);
    people.step(0.1 * i, perception, sight, {}, now);
    if (!perception.tracks().empty()) {
      thing = perception.identity().probabilities(perception.tracks()[0].id)[kThing];
    }
  }
  ASSERT_GT(thing, 0.85);
  ASSERT_EQ(now.people.size(), 1U);
  EXPECT_LT((now.people[0].position - legs_m).norm(), 0.3);
}

// Bug: the camera's track of somebody was 15 cm behind where the laser saw their legs, and the
// robot still rolled when they had walked up to it.
TEST(PeopleAround, AreWhereTheLaserSeesThemNowToo) {
  Perception perception = perceptionOfStage();
  const Eigen::Vector2d track_m(-1.6, 0.32), legs_m(-1.4, 0.28);  // behind the robot
  const LaserBodies legs = legsAt({track_m});
  RecentSight sight({}, 8.0);
  for (int i = 0; i < 20; ++i) sight.addScan(test::scanOf({}), {}, 0.1 * i);
  PeopleAround people{FollowerParams()};
  Situation now;
  now.unseen_s = 1e3;
  for (int i = 20; i < 50; ++i) {
    perception.step(ColoredStage().frame(0.1 * i), {}, &legs);
    sight.addScan(test::scanOf({legs_m}), {}, 0.1 * i);
    people.step(0.1 * i, perception, sight, {}, now);
  }
  double nearest_m = 9.0, furthest_m = 0.0;
  for (const MovingPerson& person : now.people) {
    nearest_m = std::min(nearest_m, person.position.norm());
    furthest_m = std::max(furthest_m, person.position.norm());
  }
  EXPECT_NEAR(nearest_m, legs_m.norm(), 0.05);
  EXPECT_NEAR(furthest_m, track_m.norm(), 0.05);
  EXPECT_EQ(now.people.size(), 2U);
  EXPECT_LE(people.resting().size(), 1U) << "paths lead round one of them";
}

// Bug: who set off from beside somebody who stood seemed to walk away for half a second, by the
// legs of both, and was at the robot while it rolled.
TEST(RecentSight, BesideWhoStandsNobodyIsSaidToWalkOtherwiseThanTheyDo) {
  const Eigen::Vector2d stands_m(1.2, -0.2), walks_mps(-1.0, -0.6);
  Eigen::Vector2d comes_m(1.2, 0.4);
  RecentSight sight({}, 8.0);
  for (int i = 0; i < 20; ++i) sight.addScan(test::scanOf({}), {}, 0.1 * i);
  for (int i = 20; i < 30; ++i) sight.addScan(test::scanOf({stands_m, comes_m}), {}, 0.1 * i);
  for (int i = 30; i < 40; ++i) {
    comes_m += 0.1 * walks_mps;
    sight.addScan(test::scanOf({stands_m, comes_m}), {}, 0.1 * i);
    for (const SeenThing& thing : sight.things()) {
      if ((thing.place - comes_m).norm() > 0.1) continue;
      EXPECT_LT((thing.velocity - walks_mps).norm(), thing.gait_mps) << "step " << i;
    }
  }
}

}  // namespace
}  // namespace heel
