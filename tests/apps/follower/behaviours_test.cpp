// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/drawn_map.hpp"
#include <heel/apps/follower/behaviours.hpp>
#include <heel/apps/follower/look_who.hpp>
#include <heel/apps/follower/make_room.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

using Eigen::Vector2d;

const MovingPerson kPerson{{3.0, 0.0}, {0.0, 0.0}, 0.25};
const std::vector<DoorwayOnMap> kDoorway = {{{0.0, 0.0}, {1.0, 0.0}, 0.9}};  // through along X

/// Open floor, but for what a test says.
struct Floor {
  GlobalPlan straight;
  double room_m = 10.0;
  std::optional<Vector2d> barred;  // and half a metre around it

  std::optional<Intent> ask(Behaviour& behaviour, const Situation& now) {
    const auto room = [this](const Vector2d&) { return room_m; };
    const auto plan = [this](const Vector2d& from, const Vector2d& to) -> const GlobalPlan& {
      const bool is_barred = barred && (to - *barred).norm() < 0.5;
      straight.status = is_barred ? PlanStatus::kFoundNearby : PlanStatus::kFound;
      straight.path = {from, to};
      straight.length_m = (to - from).norm();
      straight.end = to;
      return straight;
    };
    const auto takes_s = [&](const FloorPose& from, const Vector2d& to) {
      const GlobalPlan& way = plan(from.position, to);
      const bool is_open = way.status == PlanStatus::kFound;
      return is_open ? way.length_m / 0.3 : std::numeric_limits<double>::infinity();
    };
    return behaviour.step(now, {room, room, plan, takes_s});
  }
};

RobotDescription robotOf() {
  RobotDescription robot;
  robot.camera.T_base_camera.translation().z() = 1.0;
  return robot;
}

struct BehavioursTest : testing::Test {
  BehavioursTest() {
    now.elapsed_s = 0.1;
    now.last = kPerson;
  }
  FollowerParams params = fittedTo(robotOf(), {});
  Premises open{params, nullptr, {}}, with_doorway{params, nullptr, kDoorway};
  Situation now;
  Floor floor;
};

TEST_F(BehavioursTest, FollowsToAMetreOffAndKeepsThePersonInView) {
  FollowTarget follow(open, params.goal);
  now.target = kPerson;
  const auto intent = floor.ask(follow, now);
  ASSERT_TRUE(intent && intent->go_to && intent->keep_in_view);
  EXPECT_LT((*intent->go_to - Vector2d(2.0, 0.0)).norm(), 0.05);
  EXPECT_EQ(*intent->keep_in_view, kPerson.position);
  now.target.reset();
  EXPECT_EQ(*floor.ask(follow, now)->go_to, kPerson.position) << "where they were";
}

// Bug: it stood where a corner hid half of whom it followed, and lost them again and again (50006).
TEST_F(BehavioursTest, StandsWhereNoCornerHidesHalfOfThePerson) {
  WallMapBuilder builder;
  builder.add(WallBox{{1.9, 1.2}, 0.0, {0.2, 2.0}, {0.0, 2.5}});  // from y = 0.2 on
  const Premises corner(params, std::make_shared<const WallMap>(builder.build()), {});
  now.robot.position = {0.0, -0.1};
  now.target = kPerson;
  now.target->position = {2.2, 0.2};
  // Whether the corner hides what is to the left of the person's middle.
  const auto hides = [&](const Vector2d& from, double left_m) {
    const Vector2d ray = (now.target->position - from).normalized();
    const Vector2d to = now.target->position + left_m * Vector2d(-ray.y(), ray.x());
    return from.y() + (to - from).y() * (2.0 - from.x()) / (to - from).x() > 0.2;
  };
  const Vector2d straight_on(1.2, 0.06);
  ASSERT_FALSE(hides(straight_on, 0.0)) << "their middle is in view";
  ASSERT_TRUE(hides(straight_on, 0.1)) << "their left is not";
  FollowTarget follow(corner, params.goal);
  const auto intent = floor.ask(follow, now);
  ASSERT_TRUE(intent->go_to);
  EXPECT_FALSE(hides(*intent->go_to, 0.1)) << intent->go_to->transpose();
}

TEST_F(BehavioursTest, FacesThePersonWhereItStands) {
  FaceTarget face(open, params);
  now.target = kPerson;
  const auto intent = floor.ask(face, now);
  EXPECT_FALSE(intent->go_to);
  EXPECT_EQ(*intent->look_at, kPerson.position);
}

TEST_F(BehavioursTest, LeavesADoorwayBeforeItFacesThePerson) {
  FaceTarget face(with_doorway, params);
  now.target = kPerson;
  now.target->position.x() = 2.0;
  const auto intent = floor.ask(face, now);
  ASSERT_TRUE(intent->go_to);
  EXPECT_FALSE(isInPassage(kDoorway, *intent->go_to, params.goal.doorway_depth_m, 0.26));
  EXPECT_FALSE(intent->keep_in_view) << "they wait";
  EXPECT_EQ(*intent->look_at, now.target->position) << "from there";
  now.target->position.x() = 0.6;
  EXPECT_FALSE(floor.ask(face, now)->go_to) << "they leave no room to drive";
}

TEST_F(BehavioursTest, TurnsToTheSideWhereThePersonWentAndKnowsAFullTurn) {
  SeekTarget seek(0.9, 2.0);
  now.last.position = {1.0, 0.1};
  now.last.velocity = {0.0, -1.0};
  now.unseen_s = 0.5;
  seek.begin(now);
  const auto intent = floor.ask(seek, now);
  EXPECT_LT(bearingOf(now.robot, *intent->look_at), 0.0) << "they walked to the right";
  EXPECT_EQ(intent->most_turn_radps, 0.9);
  FollowingFacts facts;
  now.turned_rad = -0.1;
  for (int i = 0; i < 62; ++i) floor.ask(seek, now);
  seek.tell(facts);
  EXPECT_FALSE(facts[FollowingCondition::kFullTurn]);
  floor.ask(seek, now);
  seek.tell(facts);
  EXPECT_TRUE(facts[FollowingCondition::kFullTurn]);
}

struct LooksTest : BehavioursTest {
  LooksTest() { now.elsewhere_per_s = 0.01; }
  std::optional<Intent> step() {
    look.watch(now);
    return floor.ask(look, now);
  }
  /// For how long it looks until it does not, at most.
  double looks_s(double most_s) {
    double s = 0.0;
    while (s < most_s && step()) s += now.elapsed_s;
    return s;
  }
  void forget() {
    now.target = kPerson;
    look.watch(now);
    now.target.reset();
  }
  LookWhoThatIs look{open, params};
};

TEST_F(LooksTest, LooksAtWhoeverPromisesMore) {
  EXPECT_FALSE(step()) << "nobody may be";
  now.suspects = {{{0.0, 3.0}, 0.1}, {{0.0, -3.0}, 0.3}};
  EXPECT_EQ(*step()->look_at, now.suspects[1].place);
  now.suspects = {{{-3.0, 0.0}, 0.3}, {{3.0, 0.3}, 0.25}};
  EXPECT_EQ(*step()->look_at, now.suspects[1].place) << "that takes a short turn";
  now.elsewhere_per_s = 1.0;
  EXPECT_FALSE(step()) << "they are likelier to be elsewhere";
}

TEST_F(LooksTest, LooksFromWhereAllOfThemIsInView) {
  now.elsewhere_per_s = 0.001;
  for (const double off_m : {6.0, 1.0}) {
    forget();
    now.suspects = {{{off_m, 0.0}, 0.3}};
    EXPECT_FALSE(step()->go_to) << "a look from here costs no way";
    std::optional<Vector2d> place;
    for (int i = 0; i < 30 && !place; ++i) {
      if (const auto intent = step()) place = intent->go_to;
    }
    ASSERT_TRUE(place);
    EXPECT_NEAR((*place - now.suspects[0].place).norm(), params.whole_m, 0.2);
  }
  forget();
  now.suspects = {{{params.whole_m + 0.1, 0.0}, 0.3}};
  for (int i = 0; i < 300; ++i) {
    const auto intent = step();
    EXPECT_FALSE(intent && intent->go_to) << "all of them is in view from here";
  }
}

// Where looks say nothing for n looks long, the next one is worth 1 / (1 + n)^2.
TEST_F(LooksTest, LooksThatTellNothingAreGivenUp) {
  now.suspects = {{{2.5, 0.0}, 0.2}};
  const double one_s = params.search.map.look_s;
  const double worth_s = (std::sqrt(0.2 / (one_s * now.elsewhere_per_s)) - 1.0) * one_s;
  EXPECT_NEAR(looks_s(100.0), worth_s, 0.15);
  EXPECT_EQ(looks_s(100.0), 0.0) << "nor later, while nothing else changes";
  now.suspects[0].probability = 0.5;
  EXPECT_GT(looks_s(100.0), one_s) << "now they may rather be";
  now.suspects = {{{2.5, 2.0}, 0.2}};
  EXPECT_GT(looks_s(100.0), one_s) << "somebody elsewhere";
  forget();
  now.suspects = {{{2.5, 0.0}, 0.2}};
  EXPECT_TRUE(step()) << "they were found, and are lost again";
}

// Bug: for ten minutes the robot turned between two door frames, each of which seemed to be a body
// from the side only.
TEST_F(LooksTest, WhoIsGoneWheneverItTurnsToThemIsGivenUp) {
  double spent_s = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double bearing_rad = 1.0 - std::abs(std::fmod(0.1 * i, 4.0) - 2.0) / 2.0;
    now.suspects.clear();
    if (bearing_rad > 0.5) now.suspects = {{{0.0, 3.0}, 0.3}};
    now.robot.yaw_rad = 0.5 * M_PI - bearing_rad;
    spent_s += step() ? now.elapsed_s : 0.0;
  }
  EXPECT_GT(spent_s, 2.0);
  EXPECT_LT(spent_s, 30.0) << "of ten minutes";
}

TEST_F(LooksTest, GivesUpWhoItCanNotGetNearTo) {
  now.suspects = {{{5.0, 0.0}, 0.3}};
  double tried_s = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const auto intent = step();
    tried_s += intent && intent->go_to ? now.elapsed_s : 0.0;
  }
  EXPECT_GT(tried_s, 4.0);
  EXPECT_LT(tried_s, 40.0) << "of 200 s";
}

TEST_F(BehavioursTest, WithoutAMapThereIsNoSearch) {
  SearchForTarget search(nullptr);
  const auto intent = floor.ask(search, now);
  EXPECT_FALSE(intent->go_to || intent->look_at);
  EXPECT_STREQ(intent->reason, "waits: there is no map");
}

TEST_F(BehavioursTest, LooksFromAPlaceThenGoesOn) {
  const OccupancyGrid map = test::DrawnMap{{8.0, 4.0}, 0.1, {{{4.0, 0.0}, {4.1, 2.5}}}}.grid();
  PersonSearch search(map, map);
  search.lose({{6.0, 1.0}, {0.0, 0.0}}, 1.0, 1.0);
  SearchForTarget behaviour(&search);
  now.robot.position = {2.0, 2.0};
  behaviour.begin(now);
  const Intent first = *floor.ask(behaviour, now);
  ASSERT_TRUE(first.go_to && first.look_at);
  EXPECT_TRUE(first.is_new);
  behaviour.note({true, false});  // there, and still turning
  EXPECT_FALSE(floor.ask(behaviour, now)->is_new) << "it looks";
  behaviour.note({true, true});
  now.robot = {*first.go_to, 0.0};
  for (double yaw = 0.0; yaw < 6.3; yaw += 0.5) {
    search.look({now.robot.position, yaw}, 10.0,
                [](const Vector2d&) -> std::optional<Vector2d> { return std::nullopt; });
  }
  const Intent next = *floor.ask(behaviour, now);
  EXPECT_TRUE(next.is_new);
  EXPECT_GT((*next.go_to - *first.go_to).norm(), 0.5) << "nobody is there";
}

// Bug: the robot stood before a shut door for minutes, and looked at it.
TEST_F(BehavioursTest, LooksFromNoPlaceThatItCanNotReach) {
  const OccupancyGrid map = test::DrawnMap{{8.0, 4.0}, 0.1, {{{4.0, 0.0}, {4.1, 2.5}}}}.grid();
  PersonSearch search(map, map);
  SearchForTarget behaviour(&search);
  now.robot.position = {2.0, 2.0};
  const auto goesTo = [&] {
    search.lose({{6.0, 1.0}, {0.0, 0.0}}, 1.0, 1.0);
    behaviour.begin(now);
    return *floor.ask(behaviour, now)->go_to;
  };
  floor.barred = goesTo();
  EXPECT_GT((goesTo() - *floor.barred).norm(), 0.5);
}

struct MakeRoomTest : BehavioursTest {
  MakeRoom make_room{with_doorway, params};

  std::optional<Intent> step() {
    make_room.watch(now);
    return floor.ask(make_room, now);
  }
};

TEST_F(MakeRoomTest, LeavesADoorwayForThePersonWhoComesThroughIt) {
  now.target = MovingPerson{{1.1, 0.0}, {-0.5, 0.0}, 0.25};
  const auto intent = step();
  ASSERT_TRUE(intent && intent->go_to);
  EXPECT_FALSE(isInPassage(kDoorway, *intent->go_to, params.wayside.doorway_depth_m, 0.26));
  EXPECT_LT(intent->go_to->x(), 0.3) << "not towards them";
  EXPECT_EQ(*intent->look_at, now.target->position);
  EXPECT_TRUE(intent->is_new);
  EXPECT_FALSE(step()->is_new);
  now.last.position = now.target->position;
  now.target.reset();
  EXPECT_EQ(*step()->look_at, now.last.position) << "out of view, it looks where they were";
  now.target = MovingPerson{{-2.0, 0.0}};
  EXPECT_FALSE(step()) << "they have gone past";
}

TEST_F(MakeRoomTest, StaysWhereThereIsRoomForTwo) {
  now.robot.position = {-3.0, 0.0};
  now.target = MovingPerson{{-2.0, 0.0}, {-0.5, 0.0}, 0.25};
  EXPECT_FALSE(step());
}

TEST_F(MakeRoomTest, WaitsAsideForAWhileOnly) {
  now.target = MovingPerson{{1.1, 0.0}, {-0.5, 0.0}, 0.25};
  ASSERT_TRUE(step());
  now.target->velocity.setZero();
  double waited_s = 0.0;
  for (; step() && waited_s < 100.0; waited_s += now.elapsed_s) make_room.note({true, true});
  EXPECT_NEAR(waited_s, params.waits_aside_s, 0.25);
}

TEST_F(MakeRoomTest, GoesAsideForOthersOnlyWhileItGetsNowhere) {
  now.people = {{{0.6, 0.0}, {0.0, 0.0}, 0.25}};
  now.seen_people = 1;
  for (double t = 0.0; t < 2.0 * params.give_up_s; t += now.elapsed_s) {
    ASSERT_FALSE(step()) << "it wants to go nowhere";
  }
  now.way_to = Vector2d(0.1, 0.0);
  for (double t = 0.0; t < 2.0 * params.give_up_s; t += now.elapsed_s) {
    ASSERT_FALSE(step()) << "it is at the end of its way";
  }
  now.way_to = Vector2d(3.0, 0.0);
  double stuck_s = 0.0;
  for (; !step() && stuck_s < 100.0; stuck_s += now.elapsed_s) {
  }
  EXPECT_NEAR(stuck_s, params.give_up_s, 0.25);
}

}  // namespace
}  // namespace heel
