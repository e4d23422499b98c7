// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/small_home.hpp"
#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/experiment/rough_world.hpp>
#include <heel/planning/plan_file.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace heel {
namespace {

using testing::HasSubstr;

TEST(RoughWorld, IsReadFromNames) {
  const RoughWorld none = roughWorldOf("");
  EXPECT_FALSE(none.people || none.latency || none.map || none.laser || none.light ||
               none.odometry);
  const RoughWorld some = roughWorldOf("map,people");
  EXPECT_TRUE(some.map && some.people);
  EXPECT_FALSE(some.latency || some.laser || some.light || some.odometry);
  const RoughWorld all = roughWorldOf("all");
  EXPECT_TRUE(all.people && all.latency && all.map && all.laser && all.light && all.odometry);
}

TEST(RoughWorld, NamesTheSwitchesThatThereAre) {
  for (const char* list : {"rain", "people,rain", ",people"}) {
    try {
      roughWorldOf(list);
      ADD_FAILURE() << list;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("people, latency, map, laser, light, odometry, and all"));
    }
  }
}

TEST(RoughWorld, MovesFurnitureInTheMapAndLeavesAPieceOut) {
  const Scene scene = test::smallHome();
  const Scene map = asMapped(scene, roughWorldOf("map"), 3);
  ASSERT_EQ(map.furniture.size(), scene.furniture.size());
  int mapped = 0;
  for (std::size_t i = 0; i < map.furniture.size(); ++i) {
    mapped += map.furniture[i].in_map ? 1 : 0;
    const double off_m = (map.furniture[i].parts[0].base - scene.furniture[i].parts[0].base).norm();
    EXPECT_GT(off_m, 0.0);
    EXPECT_LE(off_m, 0.1);
  }
  EXPECT_EQ(mapped, 1);
  EXPECT_TRUE(asMapped(scene, roughWorldOf("laser"), 3).furniture[0].in_map);
}

TEST(RoughWorld, ChangesWhatIsNamedAndNoMore) {
  Scene scene = test::smallHome();
  scene.robot.laser.view_rad = 2.0 * M_PI;
  scene.robot.laser.beams = 361;
  const Scene blind = roughened(scene, roughWorldOf("people"), 3);
  EXPECT_FALSE(blind.people[0].sees_robot);
  EXPECT_EQ(blind.robot.laser.beams, 361);
  const Scene narrow = roughened(scene, roughWorldOf("laser"), 3);
  EXPECT_TRUE(narrow.people[0].sees_robot);
  EXPECT_EQ(narrow.robot.laser.beams, 221);
  EXPECT_EQ(narrow.robot.odometry.turn_bias, 0.0);
  EXPECT_NE(roughened(scene, roughWorldOf("odometry"), 3).robot.odometry.turn_bias, 0.0);
  EXPECT_EQ(latenciesOf(roughWorldOf("map"), 3).camera_s, 0.0);
  EXPECT_GE(latenciesOf(roughWorldOf("latency"), 3).camera_s, 0.1);
}

// All of it in a small home: the robot touches nothing by itself.
TEST(RoughWorld, IsNoReasonToDriveIntoAnything) {
  const std::filesystem::path plans = std::filesystem::path(HEEL_SOURCE_DIR) / "apps" / "plans";
  ClosedLoopParams params;
  params.threads = 1;
  params.limit_s = 30.0;
  params.follower.learn.acquisition.background_s = 1.0;
  params.follower.learn.acquisition.person_s = 3.0;
  params.rough = roughWorldOf("all");
  const FollowLog log = runClosedLoop(
      test::smallHome(), loadPlan(plans / "search.pnml", followingVocabulary()), params);
  for (const FollowSample& sample : log.samples) {
    ASSERT_FALSE(sample.contact_by_robot) << "at " << sample.stamp_s << " s";
  }
  EXPECT_EQ(log.outcome, "reached");
}

}  // namespace
}  // namespace heel
