// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/simulation/scene.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace heel {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What is wrong with a scene: the message of its error.
std::string complaint(const std::string& text) {
  const test::TempFolder folder;
  const std::string file = folder.write("bad.yaml", text);
  return test::messageOf([&] { loadScene(file); });
}

const char* const kRobot = "robot: {start: [1, 1]}\n";
const char* const kWalls =
    "walls:\n"
    "  - {from: [0, 0], to: [4, 0]}\n"
    "  - {from: [4, 0], to: [4, 4]}\n";

TEST(SceneFile, LoadsEveryShippedScene) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HEEL_SCENES)) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path());
    Scene scene;
    ASSERT_NO_THROW(scene = loadScene(entry.path().string()));
    EXPECT_EQ(scene.name, entry.path().stem());
    EXPECT_FALSE(scene.people.empty());
    EXPECT_FALSE(scene.lights.empty());
    ++scenes;
  }
  EXPECT_GE(scenes, 2);
}

TEST(SceneFile, ReadsWhatItSays) {
  const test::TempFolder folder;
  const Scene scene = loadScene(folder.write("s.yaml", std::string(kWalls) + R"(
furniture:
  - {name: crate, box: [1, 0.5, 0.4], at: [2, 3, 0], yaw_deg: 90, in_map: false}
people:
  - name: eva
    start: [1, 2]
    outfit: {top: {color: "#ff0000", pattern: checks, back: {color: blue}}}
    path: [{to: [2, 2], speed_mps: 0.5}, {robot_within_m: 1.5}, {wait_s: 2}]
robot: {start: [3, 1], yaw_deg: 180, laser: {beams: 361}}
)"));
  ASSERT_EQ(scene.walls.size(), 2U);
  EXPECT_DOUBLE_EQ(scene.walls[0].thickness_m, Wall().thickness_m);
  ASSERT_EQ(scene.furniture.size(), 1U);
  EXPECT_FALSE(scene.furniture[0].in_map);
  EXPECT_NEAR(scene.furniture[0].parts[0].yaw_rad, 1.5708, 1e-4);
  ASSERT_EQ(scene.people.size(), 1U);
  const Garment& top = scene.people[0].outfit.top;
  EXPECT_TRUE(top.front.color.isApprox(Rgb(1, 0, 0)));
  EXPECT_EQ(top.front.pattern, Cloth::Pattern::kChecks);
  ASSERT_TRUE(top.back.has_value());
  EXPECT_GT(top.back->color[2], top.back->color[0]);
  ASSERT_EQ(scene.people[0].path.size(), 3U);
  EXPECT_EQ(scene.people[0].path[1].kind, PathStep::Kind::kWaitForRobot);
  EXPECT_DOUBLE_EQ(scene.people[0].path[0].speed_mps, 0.5);
  EXPECT_EQ(scene.robot.laser.beams, 361);
  EXPECT_DOUBLE_EQ(scene.robot.drive.max_speed_mps, DriveLimits().max_speed_mps);
}

TEST(SceneFile, NamesFileLineAndKeyOfAnUnknownKey) {
  EXPECT_THAT(
      complaint("walls:\n  - {from: [0, 0], to: [4, 0]}\n  - {from: [0, 0], to: [4, 0], "
                "thicknes_m: 0.1}\n"),
      AllOf(HasSubstr("bad.yaml, line 3"), HasSubstr("'thicknes_m'"), HasSubstr("thickness_m")));
  EXPECT_THAT(complaint(std::string(kRobot) + "wals: []\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("'wals'"), HasSubstr("walls")));
}

TEST(SceneFile, RefusesAWallWithoutLength) {
  EXPECT_THAT(complaint("walls:\n  - {from: [1, 2], to: [1, 2]}\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("'to' of the wall"), HasSubstr("length")));
}

TEST(SceneFile, RefusesADoorwayOutsideItsWall) {
  EXPECT_THAT(complaint("walls:\n  - from: [0, 0]\n    to: [4, 0]\n    doors: [{at_m: 3.8}]\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("'at_m' of the doorway")));
}

TEST(SceneFile, RefusesAPersonOutsideTheFlatOrInAWall) {
  const std::string scene = std::string(kWalls) + kRobot;
  EXPECT_THAT(complaint(scene + "people:\n  - {name: eva, start: [9, 1]}\n"),
              AllOf(HasSubstr("line 6"), HasSubstr("'start' of the person"),
                    HasSubstr("outside the flat")));
  EXPECT_THAT(complaint(scene + "people:\n  - {name: eva, start: [2, 0.05]}\n"),
              HasSubstr("in a wall"));
  EXPECT_THAT(complaint(scene + "people:\n  - {name: eva, start: [2, 2], path: [{to: [2, 7]}]}\n"),
              HasSubstr("'to' of the step"));
}

TEST(SceneFile, RefusesASensorRateOfZero) {
  EXPECT_THAT(
      complaint("robot:\n  start: [0, 0]\n  camera:\n    rate_hz: 0\n"),
      AllOf(HasSubstr("line 4"), HasSubstr("'rate_hz' of the camera"), HasSubstr("more than 0")));
}

TEST(SceneFile, RefusesValuesOfAWrongKind) {
  EXPECT_THAT(complaint("robot: {start: [0, 0], radius_m: wide}\n"),
              AllOf(HasSubstr("line 1"), HasSubstr("'radius_m'"), HasSubstr("'wide'")));
  EXPECT_THAT(complaint("robot: {start: [0]}\n"), HasSubstr("list of 2 numbers"));
  EXPECT_THAT(complaint("robot: {start: [0, .nan]}\n"), HasSubstr("must be a number"));
  EXPECT_THAT(complaint("floor: {material: marzipan}\n"),
              AllOf(HasSubstr("'marzipan'"), HasSubstr("parquet")));
  EXPECT_THAT(complaint("floor: {color: blu}\n"), AllOf(HasSubstr("'blu'"), HasSubstr("blue")));
  EXPECT_THAT(complaint("walls: 3\n"), HasSubstr("'walls' of the scene must be a list"));
  EXPECT_THAT(complaint("- 1\n"), HasSubstr("must be a map"));
  EXPECT_THAT(complaint("robot: {start: [0, 0}\n"), HasSubstr("not YAML"));
  EXPECT_THAT(complaint("robot:\n"), HasSubstr("has no value"));
  EXPECT_THAT(complaint("name: empty\n"), HasSubstr("'robot' of the scene is missing"));
}

TEST(SceneFile, RefusesAModelThatIsNotThere) {
  EXPECT_THAT(complaint("furniture:\n  - {model: sofa, at: [0, 0, 0]}\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("'sofa'")));
  EXPECT_THAT(complaint("models: nowhere.yaml\n"),
              HasSubstr("nowhere.yaml: there is no such file"));
}

TEST(SceneFile, RefusesTwoPeopleOfOneName) {
  EXPECT_THAT(complaint(std::string(kWalls) + kRobot +
                        "people:\n  - {name: a, start: [1, 1]}\n  - {name: a, start: [2, 2]}\n"),
              AllOf(HasSubstr("line 7"), HasSubstr("another person's")));
}

TEST(SceneFile, SaysThatAFileIsMissing) {
  try {
    loadScene("no_such_scene.yaml");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no_such_scene.yaml: there is no such file");
  }
}

}  // namespace
}  // namespace heel
