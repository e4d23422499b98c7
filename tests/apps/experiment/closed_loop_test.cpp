// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/small_net.hpp"
#include "tests/support/small_home.hpp"
#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/body_check.hpp>
#include <heel/planning/plan_file.hpp>

#include <gmock/gmock.h>
#include <malloc.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using Kind = Fault::Kind;
using testing::Each;
using testing::Field;

/// Ida is learned by now, and on her way with the robot behind her.
constexpr double kOnTheWay_s = 8.0;

ClosedLoopParams quickLoop() {
  ClosedLoopParams params;
  params.threads = 1;
  params.follower.learn.acquisition.background_s = 1.0;
  params.follower.learn.acquisition.person_s = 3.0;
  return params;
}

PetriPlan searchPlan() {
  const std::filesystem::path plans = std::filesystem::path(HEEL_SOURCE_DIR) / "apps" / "plans";
  return loadPlan(plans / "search.pnml", followingVocabulary());
}

FollowLog follow(const Scene& scene, const std::vector<Fault>& faults = {}, std::uint64_t seed = 1,
                 double limit_s = 30.0) {
  ClosedLoopParams params = quickLoop();
  params.seed = seed;
  params.limit_s = limit_s;
  params.faults = faults;
  return runClosedLoop(scene, searchPlan(), params);
}

FollowLog followWith(Kind kind, double for_s, std::uint64_t seed = 1) {
  return follow(test::smallHome(), {{kind, kOnTheWay_s, kOnTheWay_s + for_s}}, seed);
}

void write(std::ostream& out, const FloorPose& pose) {
  out << pose.position.x() << ' ' << pose.position.y() << ' ' << pose.yaw_rad << ' ';
}

/// All that a sample says, to the last bit.
std::string toText(const FollowSample& s) {
  std::ostringstream out;
  out << std::hexfloat << s.stamp_s << ' ';
  write(out, s.robot_true);
  write(out, s.robot_estimated);
  out << s.position_sigma_m << ' ' << s.is_localized << ' ' << s.command.forward_mps << ' '
      << s.command.turn_radps << ' ' << s.speed_true.forward_mps << ' ' << s.speed_true.turn_radps
      << ' ' << s.state << ' ' << s.reason << ' ' << s.target_status << ' ';
  for (const auto& place : {s.person_true, s.target_estimate}) {
    if (place) {
      write(out, {*place, 0.0});
    } else {
      out << "none ";
    }
  }
  for (const Eigen::Vector2d& other : s.others_true) write(out, {other, 0.0});
  out << s.person_distance_m << ' ' << s.clearance_m << ' ' << s.contact << ' ' << s.wrong_person;
  return out.str();
}

const FollowSample& at(const FollowLog& log, double stamp_s) {
  const auto sample =
      std::find_if(log.samples.begin(), log.samples.end(),
                   [&](const FollowSample& s) { return s.stamp_s > stamp_s - 1e-6; });
  if (sample == log.samples.end()) throw std::out_of_range("the run ended before");
  return *sample;
}

bool stands(const VelocityCommand& velocity) {
  return velocity.forward_mps == 0.0 && velocity.turn_radps == 0.0;
}

/// That the run came to a good end, and that the robot was never driven over its limits.
void expectGoodEnd(const FollowLog& log) {
  EXPECT_EQ(log.outcome, "reached");
  for (const FollowSample& sample : log.samples) {
    ASSERT_FALSE(sample.contact) << "at " << sample.stamp_s << " s";
    ASSERT_FALSE(sample.wrong_person) << "at " << sample.stamp_s << " s";
    ASSERT_GE(sample.command.forward_mps, 0.0)
        << "at " << sample.stamp_s << " s, " << sample.state << ": " << sample.reason << ", "
        << sample.person_distance_m << " m from the person, who is seen to be "
        << (sample.target_estimate ? (*sample.target_estimate - *sample.person_true).norm() : -1.0)
        << " m off";
    ASSERT_LE(sample.command.forward_mps, log.drive.max_speed_mps + 1e-9);
  }
}

/// That the robot is told to stop from `blind_s` after the fault's begin on for as long as the
/// fault lasts, stands when it can have braked (from 0.3 m/s at 0.5 m/s^2), and drives a second
/// after its end.
void expectStopsAndGoesOn(const FollowLog& log, double for_s, double blind_s,
                          const std::string& reason) {
  const double braked_s = 0.3 / 0.5;
  EXPECT_GT(at(log, kOnTheWay_s).speed_true.forward_mps, 0.2) << "it was on the way";
  for (const FollowSample& sample : log.samples) {
    const double since_s = sample.stamp_s - kOnTheWay_s + 1e-6;
    if (since_s < blind_s || since_s > for_s - 0.05) continue;
    EXPECT_TRUE(stands(sample.command)) << since_s << " s after the beginning";
    EXPECT_EQ(sample.reason, reason);
    EXPECT_EQ(sample.state, "stop");
    if (since_s > blind_s + braked_s + 0.1) {
      EXPECT_TRUE(stands(sample.speed_true)) << since_s << " s after the beginning";
    }
  }
  const double way_m = (at(log, kOnTheWay_s + for_s).robot_true.position -
                        at(log, kOnTheWay_s + blind_s).robot_true.position)
                           .norm();
  EXPECT_LT(way_m, 0.3 * 0.3 / (2.0 * 0.5) + 0.3 * 0.1) << "its way to stop, and a step's";
  EXPECT_GT(at(log, kOnTheWay_s + for_s + 1.0).speed_true.forward_mps, 0.1);
}

TEST(ClosedLoop, ARobotOfCornersTouchesNothingByFclEither) {
  Scene scene = test::smallHome();
  scene.robot.drive =
      withBodyAround({{0.35, 0.2}, {0.35, -0.2}, {-0.35, -0.2}, {-0.35, 0.2}}, scene.robot.drive);
  const FollowLog log = follow(scene);
  for (Furniture& piece : scene.furniture) piece.in_map = true;
  RobotBody body;
  body.footprint = BoxFootprint{0.7, 0.4, 0.0};
  body.top_m = scene.robot.height_m;
  const BodyCheck world(body, *wallMapOf(scene).tree());
  std::vector<FloorPose> driven;
  for (const FollowSample& sample : log.samples) driven.push_back(sample.robot_true);
  EXPECT_EQ(log.outcome, "reached");
  EXPECT_EQ(world.firstCollision(driven), std::nullopt);
}

TEST(ClosedLoop, LearnsAPersonAndReachesThem) {
  const FollowLog log = follow(test::smallHome());
  expectGoodEnd(log);
  EXPECT_EQ(log.person, "ida");
  EXPECT_THAT(log.samples, Each(Field(&FollowSample::is_localized, true)));
  const FollowSample& last = log.samples.back();
  EXPECT_GT(last.person_true->x(), 4.6) << "she went where she was going";
  EXPECT_LT(last.person_distance_m, kReached_m);
  int seen = 0;
  double error_m = 0.0;
  for (const FollowSample& sample : log.samples) {
    if (sample.state == "learn") {
      EXPECT_TRUE(stands(sample.command)) << "phase 1 needs a robot that stands";
    }
    EXPECT_LT((sample.robot_estimated.position - sample.robot_true.position).norm(), 0.1);
    if (sample.target_status == "followed" && sample.target_estimate) {
      ++seen;
      error_m += (*sample.target_estimate - *sample.person_true).norm();
    }
  }
  ASSERT_GT(seen, 50);
  EXPECT_LT(error_m / seen, 0.3) << "on average; small images make it coarse";
}

// A sill, too low for both sensors, across the way.
TEST(ClosedLoop, DoesNotPushAgainstWhatNoSensorSees) {
  Scene scene = test::smallHome();
  FurniturePart sill;
  sill.base = {2.4, 2.0, 0.0};
  sill.size_m = {0.1, 1.2, 0.07};
  scene.furniture.push_back({"sill", false, {sill}});
  ClosedLoopParams params = quickLoop();
  params.limit_s = 60.0;
  const FollowLog log = runClosedLoop(scene, searchPlan(), params);
  EXPECT_EQ(log.outcome, "reached") << "around it";
  int pushes = 0;
  for (std::size_t i = 1; i < log.samples.size(); ++i) {
    const bool touches = log.samples[i].contact_by_robot;
    if (touches && log.samples[i].command.forward_mps > 0.1) ++pushes;
  }
  EXPECT_GT(pushes, 0) << "or this shows nothing";
  EXPECT_LT(pushes, 20) << "steps of a tenth of a second";
}

TEST(ClosedLoop, WithoutAMapItGoesByItsOdometryAndWhatItSees) {
  ClosedLoopParams params = quickLoop();
  params.limit_s = 30.0;
  params.has_map = false;
  const FollowLog log = runClosedLoop(test::smallHome(), searchPlan(), params);
  expectGoodEnd(log);
  for (const FollowSample& sample : log.samples) {
    EXPECT_LT((sample.robot_estimated.position - sample.robot_true.position).norm(), 0.1);
  }
}

TEST(ClosedLoop, WithoutAMapItWaitsWhereItWouldSearch) {
  Scene scene = test::smallHome();
  Wall& wall = scene.walls.emplace_back(scene.walls[0]);  // With a doorway too narrow for it.
  wall.from = {5.6, 0.0};
  wall.to = {5.6, 4.0};
  wall.doors = {{3.0, 0.45}};
  std::vector<PathStep>& path = scene.people[0].path;
  for (const auto& [x, y] : {std::pair{5.0, 3.0}, std::pair{6.4, 3.0}, std::pair{6.4, 1.4}}) {
    PathStep& walk = path.emplace_back();
    walk.kind = PathStep::Kind::kWalk;
    walk.to = {x, y};
    walk.speed_mps = 1.0;
  }
  ClosedLoopParams params = quickLoop();
  params.limit_s = 90.0;
  params.has_map = false;
  const FollowLog log = runClosedLoop(scene, searchPlan(), params);
  EXPECT_EQ(log.outcome, "timeout") << "it neither fails nor goes away";
  const FollowSample& end = log.samples.back();
  EXPECT_EQ(end.state, "search");
  EXPECT_THAT(end.reason, testing::HasSubstr("waits"));
  EXPECT_TRUE(stands(end.command));
}

/// Shelves from both walls of the small home leave an aisle of this width along its middle.
void addAisle(Scene& scene, double from_x, double to_x, double width_m) {
  const double deep_m = 0.5 * (4.0 - width_m);
  for (const double y : {0.5 * deep_m, 4.0 - 0.5 * deep_m}) {
    FurniturePart shelf;
    shelf.base = {0.5 * (from_x + to_x), y, 0.0};
    shelf.size_m = {to_x - from_x, deep_m, 1.6};
    shelf.surface = {"wood", Rgb(0.4F, 0.35F, 0.3F)};
    Furniture& furniture = scene.furniture.emplace_back();
    furniture.name = "shelf";
    furniture.parts = {shelf};
  }
}

PathStep walkTo(double x, double y, double speed_mps) {
  PathStep step;
  step.kind = PathStep::Kind::kWalk;
  step.to = {x, y};
  step.speed_mps = speed_mps;
  return step;
}

/// Ida walks on into an aisle without another end, and out again when the robot has come after her.
Scene deadEnd() {
  Scene scene = test::smallHome();
  scene.robot.laser.view_rad = 6.283;
  scene.robot.laser.beams = 361;
  addAisle(scene, 4.5, 7.0, 1.1);
  std::vector<PathStep>& path = scene.people[0].path;
  const auto awaitRobot = [&path](double within_m) {
    PathStep step;
    step.kind = PathStep::Kind::kWaitForRobot;
    step.robot_within_m = within_m;
    path.push_back(step);
  };
  path.push_back(walkTo(6.4, 2.0, 0.5));
  awaitRobot(1.3);
  path.push_back(walkTo(4.0, 2.0, 0.5));
  path.push_back(walkTo(2.0, 1.2, 0.5));
  awaitRobot(1.4);
  return scene;
}

TEST(ClosedLoop, LetsThePersonOutOfADeadEnd) {
  const FollowLog log = follow(deadEnd(), {}, 1, 70.0);
  EXPECT_EQ(log.outcome, "reached");
  double deepest_m = 0.0;
  for (const FollowSample& sample : log.samples) {
    ASSERT_FALSE(sample.contact) << "at " << sample.stamp_s << " s";
    deepest_m = std::max(deepest_m, sample.robot_true.position.x());
  }
  EXPECT_GT(deepest_m, 4.7) << "it stood in the aisle";
  EXPECT_LT(log.samples.back().person_true->x(), 2.5) << "and she came out";
}

/// Ida walks on through a passage too narrow for two, and out of sight. Ben, who does not see the
/// robot, comes through it against the robot, and does not give up.
Scene meetingInAPassage() {
  Scene scene = test::smallHome();
  addAisle(scene, 3.9, 5.4, 0.9);
  ScenePerson ben = scene.people.front();
  ben.name = "ben";
  ben.start = {6.0, 1.3};
  ben.outfit.top.front.color = {0.1F, 0.2F, 0.5F};
  ben.sees_robot = false;
  ben.path.clear();
  ben.path.emplace_back().wait_s = 16.0;
  ben.path.push_back(walkTo(5.8, 2.0, 0.6));
  for (int i = 0; i < 5; ++i) ben.path.push_back(walkTo(2.0, 1.2, 0.6));
  scene.people.push_back(ben);
  std::vector<PathStep>& path = scene.people.front().path;
  path.push_back(walkTo(6.2, 2.0, 0.6));
  path.push_back(walkTo(6.2, 3.3, 0.6));
  return scene;
}

TEST(ClosedLoop, LetsSomebodyThroughAPassageWhoDoesNotSeeIt) {
  const FollowLog log = follow(meetingInAPassage(), {}, 1, 60.0);
  EXPECT_EQ(log.outcome, "reached");
  EXPECT_LT(log.samples.back().others_true.front().x(), 3.5) << "he came through";
  for (const FollowSample& sample : log.samples) ASSERT_FALSE(sample.contact_by_robot);
}

// She stands beside a doorway, behind the wall: the way to her leads out of view of her. There is a
// second doorway, and she is no reason to go round by it.
TEST(ClosedLoop, GoesThroughTheDoorwayThatThePersonStandsBehind) {
  Scene scene = test::smallHome();
  Wall wall = scene.walls.front();
  wall.from = {4.4, 0.0};
  wall.to = {4.4, 4.0};
  wall.doors = {{1.0, 0.9}, {3.0, 0.9}};
  scene.walls.push_back(wall);
  std::vector<PathStep>& path = scene.people.front().path;
  path.back().to = {4.0, 1.0};
  for (const Eigen::Vector2d& to : {Eigen::Vector2d(4.5, 1.0), Eigen::Vector2d(5.0, 1.6)}) {
    path.push_back(path.back());
    path.back().to = to;
  }
  const FollowLog log = follow(scene, {}, 1, 25.0);
  EXPECT_EQ(log.outcome, "reached");
}

TEST(ClosedLoop, IsTheSameToTheLastBitForTheSameSeedAndNoOther) {
  const FollowLog one = follow(test::smallHome()), same = follow(test::smallHome());
  const FollowLog other = follow(test::smallHome(), {}, 2);
  ASSERT_EQ(one.samples.size(), same.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    ASSERT_EQ(toText(one.samples[i]), toText(same.samples[i]));
  }
  EXPECT_NE(toText(at(one, 10.0)), toText(at(other, 10.0)));
}

/// What the process holds on its heap; 0 where that can't be told.
std::size_t heap_KiB() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 info = mallinfo2();
  return (info.uordblks + info.hblkhd) / 1024;
#else
  return 0;
#endif
}

TEST(ClosedLoop, HoldsNoMoreMemoryTheLongerItFollows) {
  if (heap_KiB() == 0) GTEST_SKIP() << "this system does not tell what the heap holds";
  Scene scene = test::smallHome();
  std::vector<PathStep>& path = scene.people[0].path;
  for (int round = 0; round < 5; ++round) {
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(5.2, 3.0), Eigen::Vector2d(2.0, 3.0),
                                          Eigen::Vector2d(2.0, 1.0), Eigen::Vector2d(5.2, 1.0)}) {
      path.push_back(path.back());  // a walk at her speed
      path.back().to = corner;
    }
  }
  ClosedLoopParams params = quickLoop();
  params.limit_s = 90.0;
  std::vector<std::size_t> held_KiB;
  held_KiB.reserve(1000);
  const FollowLog log = runClosedLoop(scene, searchPlan(), params,
                                      [&](const auto&...) { held_KiB.push_back(heap_KiB()); });
  ASSERT_EQ(log.samples.size(), held_KiB.size());
  ASSERT_GT(log.samples.back().stamp_s, 89.0);
  // Longer reasons of the run's log take 0.1 KiB each; a picture would take 56.
  EXPECT_LT(held_KiB.back(), held_KiB[held_KiB.size() / 2] + 64);
}

TEST(ClosedLoop, EndsWhereNobodyComes) {
  Scene scene = test::smallHome();
  scene.people[0].path.resize(1);  // She waits beside the robot.
  scene.people[0].path[0].wait_s = 1000.0;
  const FollowLog log = follow(scene);
  EXPECT_EQ(log.outcome, "timeout");
  EXPECT_THAT(log.samples, Each(Field(&FollowSample::state, "learn")));
}

TEST(ClosedLoop, NeedsAPerson) {
  Scene scene = test::smallHome();
  scene.people.clear();
  EXPECT_THROW(follow(scene), std::runtime_error);
}

TEST(ClosedLoop, WithoutTheCameraItStopsAndGoesOn) {
  const FollowLog log = followWith(Kind::kNoCamera, 2.0);
  expectGoodEnd(log);
  expectStopsAndGoesOn(log, 2.0, 0.7, "no usable image");
}

TEST(ClosedLoop, WithoutTheLaserItStopsAndGoesOn) {
  const FollowLog log = followWith(Kind::kNoLaser, 2.0);
  expectGoodEnd(log);
  expectStopsAndGoesOn(log, 2.0, 0.4, "no laser scan");
}

TEST(ClosedLoop, WithTheLightsOutItStopsAndGoesOn) {
  const FollowLog log = followWith(Kind::kLightsOut, 3.0);
  expectGoodEnd(log);
  expectStopsAndGoesOn(log, 3.0, 0.7, "no usable image");
}

TEST(ClosedLoop, WithAPairOutOfStepItStopsAndGoesOn) {
  const FollowLog log = followWith(Kind::kPairOutOfStep, 2.0);
  expectGoodEnd(log);
  expectStopsAndGoesOn(log, 2.0, 0.7, "no usable image");
}

TEST(ClosedLoop, WhereTheClockJumpsItStopsForAStep) {
  const FollowLog log = followWith(Kind::kClockJumps, 1.0);
  expectGoodEnd(log);
  for (const double jump_s : {kOnTheWay_s, kOnTheWay_s + 1.0}) {
    EXPECT_EQ(at(log, jump_s).reason, "the clock jumped");
    EXPECT_TRUE(stands(at(log, jump_s).command));
    EXPECT_GT(at(log, jump_s + 0.5).speed_true.forward_mps, 0.2);
  }
}

TEST(ClosedLoop, WhereTheClockIsSetBackItGoesOnSeeing) {
  const FollowLog log = followWith(Kind::kClockBack, 3.0);
  expectGoodEnd(log);
  EXPECT_EQ(at(log, kOnTheWay_s).reason, "the clock jumped");
  for (double after_s = 0.2; after_s < 2.0; after_s += 0.1) {
    const FollowSample& sample = at(log, kOnTheWay_s + after_s);
    ASSERT_TRUE(sample.target_estimate) << after_s;
    EXPECT_LT((*sample.target_estimate - *sample.person_true).norm(), 0.3) << after_s;
  }
}

TEST(ClosedLoop, EndsWhereThePlanComesToItsGoal) {
  const PetriNet net = test::SmallNet()
                           .place("stop.exec", 1)
                           .place("goal")
                           .place("fail")
                           .transition("stop.end [targetSeen]", {"stop.exec"}, {"goal"});
  const FollowLog log =
      runClosedLoop(test::smallHome(), makePlan(net, followingVocabulary()), quickLoop());
  EXPECT_EQ(log.outcome, "done");
  EXPECT_LT(log.samples.back().stamp_s, kOnTheWay_s);
}

TEST(ClosedLoop, LearnsThoughTheClockJumps) {
  // Back while the room is learned, and while Ida is awaited, and forth and back while she is seen.
  expectGoodEnd(follow(test::smallHome(), {{Kind::kClockJumps, 0.0, 0.5},
                                           {Kind::kClockJumps, 1.4, 1.8},
                                           {Kind::kClockJumps, 3.5, 4.0}}));
}

TEST(ClosedLoop, AFrameOfNoiseStopsNobody) {
  const FollowLog log = followWith(Kind::kNoise, 0.05);
  expectGoodEnd(log);
  EXPECT_GT(at(log, kOnTheWay_s + 1.0).speed_true.forward_mps, 0.1);
}

TEST(ClosedLoop, KnowsWhereItIsThoughTheWheelsSlip) {
  const FollowLog log = followWith(Kind::kWheelsSlip, 3.0);
  expectGoodEnd(log);
  EXPECT_THAT(log.samples, Each(Field(&FollowSample::is_localized, true)));
  for (const FollowSample& sample : log.samples) {
    const FloorPose error = sample.robot_true.inverse() * sample.robot_estimated;
    ASSERT_LT(error.position.norm(), 0.15) << "at " << sample.stamp_s << " s";
    ASSERT_LT(std::abs(error.yaw_rad), 0.1) << "at " << sample.stamp_s << " s";
  }
}

TEST(ClosedLoop, LearnsThoughItIsDarkForAWhile) {
  const FollowLog log = follow(test::smallHome(), {{Kind::kLightsOut, 2.5, 4.0}});
  expectGoodEnd(log);
}

}  // namespace
}  // namespace heel
