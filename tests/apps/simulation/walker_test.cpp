// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

/// Runs a scene for some seconds; calls `visit` every tenth of one.
template <typename Visit>
void live(Simulator& simulator, double duration_s, const Visit& visit) {
  for (int i = 0; i < std::lround(duration_s * 10); ++i) visit(simulator.step(0.1).truth);
}

PathStep walkTo(double x, double y, double speed_mps = 1.0) {
  PathStep step;
  step.kind = PathStep::Kind::kWalk;
  step.to = {x, y};
  step.speed_mps = speed_mps;
  return step;
}

TEST(Walker, ArrivesWhenItsSpeedSays) {
  Scene scene = test::squareRoom();
  scene.robot.start = {-2.0, -2.0};
  scene.people.push_back(test::standingPerson("eva", -2.0, 1.0));
  scene.people[0].path = {walkTo(2.0, 1.0, 0.8)};
  Simulator simulator(scene, {1, 0, false});
  double arrived_s = 0.0;
  for (int i = 1; arrived_s == 0.0 && i < 100; ++i) {
    simulator.step(0.1);
    if (simulator.everyoneIsDone()) arrived_s = 0.1 * i;
  }
  EXPECT_NEAR(arrived_s, 4.0 / 0.8, 0.5);
}

TEST(Walker, WaitsUntilTheRobotIsNear) {
  Scene scene = test::squareRoom();
  scene.robot.start = {-2.0, 0.0};
  scene.people.push_back(test::standingPerson("eva", 0.0, 0.0));
  PathStep wait;
  wait.kind = PathStep::Kind::kWaitForRobot;
  wait.robot_within_m = 1.2;
  scene.people[0].path = {wait, walkTo(2.0, 0.0)};
  Simulator simulator(scene, {1, 0, false});
  live(simulator, 5.0,
       [](const WorldTruth& truth) { EXPECT_NEAR(truth.people[0].position.x(), 0.0, 1e-9); });
  for (int i = 0; i < 40; ++i) simulator.step(0.1, {0.3, 0.0});  // 1.1 m nearer.
  live(simulator, 3.0, [](const WorldTruth&) {});
  EXPECT_TRUE(simulator.everyoneIsDone());
}

TEST(Walker, SeesTheRobotOverWhatIsLowerThanIt) {
  for (const double high_m : {0.8, 1.8}) {
    Scene scene = test::squareRoom();
    scene.robot.start = {-1.0, 0.0};
    scene.robot.height_m = 1.1;
    FurniturePart chest;
    chest.base = {-0.5, 0.0, 0.0};
    chest.size_m = {0.2, 2.0, high_m};
    scene.furniture.push_back({"chest", true, {chest}});
    scene.people.push_back(test::standingPerson("eva", 0.0, 0.0));
    PathStep wait;
    wait.kind = PathStep::Kind::kWaitForRobot;
    wait.robot_within_m = 1.2;
    scene.people[0].path = {wait};
    Simulator simulator(scene, {1, 0, false});
    simulator.step(0.1);
    EXPECT_EQ(simulator.everyoneIsDone(), high_m < 1.1);
  }
}

/// Eva has shown herself to the robot, gone ahead, and waits for it in vain.
Scene robotStaysBehind(bool comes_back) {
  Scene scene = test::squareRoom();
  scene.robot.start = {-2.0, 0.0};
  scene.people.push_back(test::standingPerson("eva", -0.5, 0.0));
  PathStep wait;
  wait.kind = PathStep::Kind::kWaitForRobot;
  wait.robot_within_m = 1.2;
  wait.patience_s = 2.0;
  wait.comes_back = comes_back;
  scene.people[0].path = {walkTo(-0.9, 0.0), walkTo(2.0, 0.0), wait, walkTo(2.0, 2.0)};
  return scene;
}

TEST(Walker, ComesBackForARobotThatStaysBehind) {
  Simulator simulator(robotStaysBehind(true), {1, 0, false});
  live(simulator, 5.0, [](const WorldTruth&) {});
  EXPECT_NEAR(simulator.step(0.0).truth.people[0].position.x(), 2.0, 0.3);
  live(simulator, 6.0, [](const WorldTruth&) {});
  EXPECT_NEAR(simulator.step(0.0).truth.people[0].position.x(), -0.85, 0.3);
  EXPECT_FALSE(simulator.everyoneIsDone());
  // It follows: they lead on, and are done when it has come.
  for (int i = 0; i < 150; ++i) simulator.step(0.1, {0.3, 0.0});
  live(simulator, 5.0, [](const WorldTruth&) {});
  EXPECT_TRUE(simulator.everyoneIsDone());
}

TEST(Walker, GoesOnWithoutARobotThatStaysBehind) {
  Simulator simulator(robotStaysBehind(false), {1, 0, false});
  live(simulator, 10.0, [](const WorldTruth&) {});
  EXPECT_TRUE(simulator.everyoneIsDone());
}

TEST(Walker, TurnsToWhatItFaces) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 1.0, 1.0));
  PathStep face = walkTo(1.0, -2.0);
  face.kind = PathStep::Kind::kFace;
  scene.people[0].path = {face};
  Simulator simulator(scene, {1, 0, false});
  live(simulator, 2.0, [](const WorldTruth&) {});
  EXPECT_NEAR(simulator.step(0.0).truth.people[0].yaw_rad, -1.5708, 0.05);
}

TEST(Walker, StepsAroundSomeoneWhoComesTowardsIt) {
  Scene scene = test::squareRoom();
  scene.robot.start = {0.0, -2.5};
  scene.people.push_back(test::standingPerson("eva", -2.2, 0.0));
  scene.people.push_back(test::standingPerson("ida", 2.2, 0.0));
  scene.people[0].path = {walkTo(2.2, 0.0)};
  scene.people[1].path = {walkTo(-2.2, 0.0)};
  Simulator simulator(scene, {1, 0, false});
  double nearest = 10.0;
  live(simulator, 9.0, [&](const WorldTruth& truth) {
    nearest = std::min(nearest, (truth.people[0].position - truth.people[1].position).norm());
  });
  EXPECT_TRUE(simulator.everyoneIsDone());
  EXPECT_GT(nearest, 0.42);  // Shoulder to shoulder, but not through each other.
}

// Bug: who had stepped aside for others cut the corner to the next place, through the wall.
TEST(Walker, WalksAlongAWallAndNotThroughIt) {
  Scene scene = test::squareRoom();
  scene.robot.start = {-2.0, 2.0};
  Wall wall = scene.walls[0];
  wall.from = {0.0, -3.0};
  wall.to = {0.0, 0.0};
  scene.walls.push_back(wall);
  scene.people.push_back(test::standingPerson("eva", -1.0, -0.6));
  scene.people[0].path = {walkTo(1.0, 0.4)};
  Simulator simulator(scene, {1, 0, false});
  const FloorPlan plan(scene);
  live(simulator, 6.0, [&](const WorldTruth& truth) {
    EXPECT_GT(plan.clearance(truth.people[0].position), 0.149);
  });
  EXPECT_TRUE(simulator.everyoneIsDone());
}

// Bug: whom others had pushed off their way stood in a corner for good, on the wrong side of a
// wall.
TEST(Walker, GoesBackWhereAWallIsInTheWay) {
  Scene scene = test::squareRoom();
  scene.robot.start = {2.0, -2.0};
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(0.0, -3.0), Eigen::Vector2d(-0.7, 0.0)}) {
    Wall wall = scene.walls[0];
    wall.from = end;
    wall.to = {0.0, 0.0};
    scene.walls.push_back(wall);
  }
  scene.people.push_back(test::standingPerson("eva", -1.5, 0.5));
  scene.people[0].path = {walkTo(-0.4, -0.6), walkTo(1.0, 0.4)};
  Simulator simulator(scene, {1, 0, false});
  Eigen::Vector2d last(0.0, 0.0);
  live(simulator, 12.0, [&](const WorldTruth& truth) { last = truth.people[0].position; });
  EXPECT_LT((last - Eigen::Vector2d(1.0, 0.4)).norm(), 0.3);
}

TEST(Walker, StepsAroundTheRobot) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", -2.2, 0.05));
  scene.people[0].path = {walkTo(2.2, 0.0)};
  Simulator simulator(scene, {1, 0, false});
  double least = 10.0;
  live(simulator, 8.0,
       [&](const WorldTruth& truth) { least = std::min(least, truth.clearance_m); });
  EXPECT_TRUE(simulator.everyoneIsDone());
  EXPECT_GT(least, 0.0);
}

TEST(Walker, NeverPushesARobotInItsWay) {
  // A corridor which the robot, standing or creeping on, leaves no room in.
  for (const double creep_mps : {0.0, 0.05}) {
    Scene scene = test::squareRoom();
    for (const double y : {-0.45, 0.45}) {
      Wall& wall = scene.walls.emplace_back();
      wall.from = {-2.9, y};
      wall.to = {2.9, y};
    }
    scene.robot.start = {0.0, 0.0};
    scene.people.push_back(test::standingPerson("eva", 2.0, 0.0));
    scene.people[0].path = {walkTo(-2.0, 0.0, 0.6)};
    Simulator simulator(scene, {1, 0, false});
    for (int i = 0; i < 80; ++i) {
      EXPECT_FALSE(simulator.step(0.1, {creep_mps, 0.0}).truth.contact) << creep_mps << " " << i;
    }
  }
}

TEST(Walker, BumpsIntoARobotThatItDoesNotSeeAndStepsRoundIt) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", -2.2, 0.0));
  scene.people[0].sees_robot = false;
  PathStep wait;
  wait.kind = PathStep::Kind::kWaitForRobot;
  wait.robot_within_m = 0.1;
  scene.people[0].path = {wait, walkTo(2.2, 0.0)};
  Simulator simulator(scene, {1, 0, false});
  bool touches = false;
  live(simulator, 12.0, [&](const WorldTruth& truth) {
    touches = touches || truth.contact;
    EXPECT_FALSE(truth.contact_by_robot) << "it stands";
    EXPECT_GT(truth.clearance_m, -0.03);
  });
  EXPECT_TRUE(touches);
  EXPECT_TRUE(simulator.everyoneIsDone());
}

TEST(Walker, IsTouchedByARobotThatDrivesIntoIt) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 1.0, 0.0));
  Simulator simulator(scene, {1, 0, false});
  bool by_robot = false;
  for (int i = 0; i < 40; ++i) {
    by_robot = by_robot || simulator.step(0.1, {0.3, 0.0}).truth.contact_by_robot;
  }
  EXPECT_TRUE(by_robot);
}

TEST(Walker, MakesRoomForARobotThatHoldsItUp) {
  Scene scene = test::squareRoom();
  for (const double y : {-0.45, 0.45}) {
    Wall& wall = scene.walls.emplace_back();
    wall.from = {-0.5, y};
    wall.to = {0.5, y};
  }
  scene.robot.start = {-0.2, 0.0};
  scene.people.push_back(test::standingPerson("eva", 1.5, 0.0));
  scene.people[0].path = {walkTo(-2.5, 0.0, 0.6)};
  Simulator simulator(scene, {1, 0, false});
  double nearest_m = 9.0, furthest_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    const WorldTruth& truth = simulator.step(0.1).truth;
    const double away_m = truth.people[0].position.norm();
    nearest_m = std::min(nearest_m, away_m);
    if (nearest_m < 0.8) furthest_m = std::max(furthest_m, away_m);
  }
  EXPECT_LT(nearest_m, 0.8) << "it came up to the robot";
  EXPECT_GT(furthest_m, 1.0) << "and stepped back";
}

TEST(Body, StandsOnTheFloorAndIsAsTallAsItSays) {
  ScenePerson person;
  person.height_m = 1.8;
  for (const double speed : {0.0, 0.6, 1.3}) {
    for (double gait = 0.0; gait < 6.3; gait += 0.3) {
      BodyPose pose;
      pose.speed_mps = speed;
      pose.gait_rad = gait;
      std::vector<BodyPart> parts;
      appendBody(person, 0, pose, parts);
      float low = 10.0F, high = 0.0F;
      for (const BodyPart& part : parts) {
        low = std::min({low, part.a.z() - part.radius_a, part.b.z() - part.radius_b});
        high = std::max({high, part.a.z() + part.radius_a, part.b.z() + part.radius_b});
      }
      EXPECT_NEAR(low, 0.0, 0.04) << speed << ' ' << gait;
      EXPECT_NEAR(high, 1.8, speed == 0.0 ? 0.015 : 0.09) << speed << ' ' << gait;
    }
  }
}

}  // namespace
}  // namespace heel
