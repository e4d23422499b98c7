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
  EXPECT_FALSE(some.hurry || some.latency || some.laser || some.light || some.odometry);
  const RoughWorld all = roughWorldOf("all");
  EXPECT_TRUE(all.hurry && all.company && all.skirts && all.drawers);
  EXPECT_TRUE(all.doors && all.steps && all.black && all.glass && all.dropouts);
  EXPECT_TRUE(all.people && all.latency && all.map && all.laser && all.light && all.odometry);
}

TEST(RoughWorld, NamesTheSwitchesThatThereAre) {
  for (const char* list : {"rain", "people,rain", ",people"}) {
    try {
      roughWorldOf(list);
      ADD_FAILURE() << list;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(
          error.what(),
          HasSubstr(
              "people, hurry, company, skirts, drawers, doors, steps, black, glass, dropouts, "
              "latency, map, laser, light, odometry, and all"));
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

/// The small home, where two more walk to and fro across the room.
Scene busyHome() {
  Scene scene = test::smallHome();
  for (const char* name : {"bo", "cy"}) {
    ScenePerson other;
    other.name = name;
    other.start = {3.0, 1.0};
    other.repeat = true;
    for (int i = 0; i < 100; ++i) {
      PathStep step;
      step.kind = PathStep::Kind::kWalk;
      step.to = {i % 2 == 0 ? 4.0 : 3.0, 1.0};
      other.path.push_back(step);
    }
    scene.people.push_back(other);
  }
  return scene;
}

TEST(RoughWorld, OthersHurryAndAnybodyStopsNowAndThen) {
  const Scene scene = busyHome();
  const Scene rough = roughened(scene, roughWorldOf("hurry"), 3);
  ASSERT_EQ(rough.people.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double before_mps = scene.people[i].path.back().speed_mps;
    double faster = 0.0;
    int stops = 0;
    for (const PathStep& step : rough.people[i].path) {
      if (step.kind == PathStep::Kind::kWalk) faster = step.speed_mps / before_mps;
      stops += step.kind == PathStep::Kind::kWait && step.wait_s >= 0.5 ? 1 : 0;
      EXPECT_LE(step.kind == PathStep::Kind::kWait ? step.wait_s : 0.0, 2.0);
    }
    EXPECT_EQ(rough.people[i].path.back().to, scene.people[i].path.back().to);
    if (i == 0) {  // the person to follow
      EXPECT_EQ(faster, 1.0);
      continue;
    }
    EXPECT_GT(faster, 1.0);
    EXPECT_LE(faster, 1.6);
    EXPECT_GT(stops, 5);
    EXPECT_LT(stops, 30);
  }
}

TEST(RoughWorld, CompanyWalksBesideOthers) {
  int companions = 0, children = 0;
  const Scene scene = busyHome();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene rough = roughened(scene, roughWorldOf("company"), seed);
    for (std::size_t i = 3; i < rough.people.size(); ++i, ++companions) {
      const ScenePerson& one = rough.people[i];
      children += one.height_m < 1.3 ? 1 : 0;
      EXPECT_NE(one.name, "ida's company");
      EXPECT_NEAR((one.start - scene.people[1].start).norm(), 0.55, 0.01);
      ASSERT_EQ(one.path.size(), 100U);
      for (const PathStep& step : one.path) {
        EXPECT_NEAR(std::abs(step.to.y() - 1.0), 0.55, 0.01) << "beside the way, which is along X";
      }
    }
  }
  EXPECT_GT(companions, 10);
  EXPECT_LT(companions, 30);
  EXPECT_GT(children, 3);
  EXPECT_LT(children, companions - 3);
}

TEST(RoughWorld, OpensDrawersThatNoMapShows) {
  int drawers = 0;
  const Scene scene = busyHome();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene rough = roughened(scene, roughWorldOf("drawers"), seed);
    for (std::size_t i = scene.furniture.size(); i < rough.furniture.size(); ++i, ++drawers) {
      const FurniturePart& drawer = rough.furniture[i].parts.front();
      EXPECT_FALSE(rough.furniture[i].in_map);
      EXPECT_GT(drawer.base.z(), rough.robot.laser.at.z()) << "no laser sees it";
      EXPECT_LT(drawer.base.z(), rough.robot.height_m);
    }
  }
  EXPECT_GT(drawers, 5);
}

TEST(RoughWorld, HangsDoorsWhereTheyAreInNobodysWay) {
  Scene scene = busyHome();
  Wall wall;
  wall.from = {4.5, 0.0};
  wall.to = {4.5, 4.0};
  wall.doors = {{1.0, 0.9, 2.05}, {2.5, 0.9, 2.05}};
  scene.walls.push_back(wall);
  ScenePerson goer;
  goer.start = {3.0, 2.5};
  PathStep step;
  step.kind = PathStep::Kind::kWalk;
  step.to = {6.0, 2.5};
  goer.path = {step};
  scene.people = {goer};
  int open = 0, shut = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene rough = roughened(scene, roughWorldOf("doors"), seed);
    for (std::size_t i = scene.furniture.size(); i < rough.furniture.size(); ++i) {
      EXPECT_FALSE(rough.furniture[i].in_map);
      const Eigen::Vector2d at = rough.furniture[i].parts.front().base.head<2>();
      const bool is_shut = (at - Eigen::Vector2d(4.5, 1.0)).norm() < 1e-9;
      (is_shut ? shut : open) += 1;
      if (!is_shut) {
        EXPECT_GT(std::abs(at.y() - 2.5), 0.35) << "in the way";
        EXPECT_LT((at - Eigen::Vector2d(4.5, 2.5)).norm(), 0.9) << "at its doorway";
      }
    }
  }
  EXPECT_GT(shut, 5);
  EXPECT_GT(open, 5);
}

TEST(RoughWorld, StepsDownAreWhereNobodyWalks) {
  int steps = 0;
  const Scene scene = busyHome();
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const FloorArea& area : roughened(scene, roughWorldOf("steps"), seed).floor_areas) {
      EXPECT_GE(area.depth_m, 0.15);
      EXPECT_LE(area.depth_m, 0.5);
      for (double x = 3.0; x <= 4.0; x += 0.1) {  // They walk along y = 1.
        const Eigen::Vector2d on_way(x, 1.0);
        const Eigen::Vector2d nearest = on_way.cwiseMax(area.low).cwiseMin(area.high);
        EXPECT_GT((nearest - on_way).norm(), 0.4);
      }
      ++steps;
    }
  }
  EXPECT_GT(steps, 10);
  EXPECT_LE(steps, 60);
}

TEST(RoughWorld, CoversSomeOfTheFurnitureWithWhatNoLaserSees) {
  Scene scene = busyHome();
  scene.furniture.front().in_map = false;
  int velvet = 0, glass = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const Furniture& piece : roughened(scene, roughWorldOf("black"), seed).furniture) {
      velvet += piece.parts.front().surface.material == "velvet" ? 1 : 0;
    }
    for (const Furniture& piece : roughened(scene, roughWorldOf("glass"), seed).furniture) {
      const bool is_glass = piece.parts.front().surface.material == "frosted glass";
      EXPECT_FALSE(is_glass && !piece.in_map) << "nothing could see it";
      glass += is_glass ? 1 : 0;
    }
  }
  EXPECT_NEAR(velvet, 20, 10) << "of 100";
  EXPECT_NEAR(glass, 10, 7) << "of 50";
}

TEST(RoughWorld, DropsOutNowAndThen) {
  EXPECT_TRUE(dropoutsOf(roughWorldOf("latency"), 300.0, 3).empty());
  int cameras = 0, lasers = 0;
  for (const Fault& fault : dropoutsOf(roughWorldOf("dropouts"), 300.0, 3)) {
    (fault.kind == Fault::Kind::kNoCamera ? cameras : lasers) += 1;
    EXPECT_GE(fault.to_s - fault.from_s, 0.2);
    EXPECT_LE(fault.to_s - fault.from_s, 2.0);
    EXPECT_LE(fault.from_s, 300.0);
  }
  EXPECT_NEAR(cameras, 20, 8);
  EXPECT_NEAR(lasers, 20, 8);
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
