// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/planning/global_planner.hpp>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kSeeds = 40;
constexpr double kRobot_m = 0.26, kSafety_m = 0.08;
constexpr double kBody_m = 0.2;  // Of a person who walks.

std::filesystem::path scenes() {
  return std::filesystem::path(HEEL_SOURCE_DIR) / "apps" / "scenes";
}

RandomHome homeOf(std::uint64_t seed) {
  return randomHome(seed, scenes() / "models" / "furniture.yaml");
}

/// What the robot must not touch, whether its map shows it or not.
OccupancyGrid everythingIn(Scene scene) {
  for (Furniture& piece : scene.furniture) piece.in_map = true;
  return wallMapOf(scene).floorGrid({0.05, scene.robot.height_m});
}

/// The place with the most room.
Vector2d middleOf(const Room& room, const FloorPlan& plan) {
  Vector2d best = room.low;
  for (double x = room.low.x(); x < room.high.x(); x += 0.1) {
    for (double y = room.low.y(); y < room.high.y(); y += 0.1) {
      if (plan.clearance({x, y}) > plan.clearance(best)) best = {x, y};
    }
  }
  return best;
}

/// All that distinguishes one scene from another, here: places.
std::string placesOf(const Scene& scene) {
  std::string places;
  const auto add = [&places](double x, double y) {
    places += std::to_string(x) + "," + std::to_string(y) + " ";
  };
  add(scene.robot.start.x(), scene.robot.start.y());
  for (const Wall& wall : scene.walls) {
    add(wall.from.x(), wall.from.y());
    add(wall.to.x(), wall.to.y());
    for (const Doorway& door : wall.doors) add(door.at_m, door.width_m);
  }
  for (const Furniture& piece : scene.furniture) {
    places += piece.name + (piece.in_map ? "+" : "-");
    for (const FurniturePart& part : piece.parts) add(part.base.x(), part.base.y());
  }
  for (const ScenePerson& person : scene.people) {
    places += person.name;
    add(person.start.x(), person.start.y());
    for (const PathStep& step : person.path) {
      add(step.to.x(), step.to.y());
      add(step.speed_mps, step.wait_s + step.robot_within_m);
    }
  }
  return places;
}

TEST(RandomHome, ARobotGetsIntoEveryRoom) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RandomHome home = homeOf(seed);
    ASSERT_EQ(home.rooms.size(), 6U);
    const FloorPlan floor(home.scene);
    GlobalPlannerParams params;
    params.robot_radius_m = kRobot_m;
    params.safety_m = kSafety_m;
    GlobalPlanner planner(everythingIn(home.scene), params);
    for (const Room& room : home.rooms) {
      const GlobalPlan plan = planner.plan(home.scene.robot.start, middleOf(room, floor));
      EXPECT_EQ(plan.status, PlanStatus::kFound)
          << "seed " << seed << ", " << room.name << ": " << nameOf(plan.status);
      EXPECT_EQ(plan.escape_m, 0.0) << "seed " << seed;
    }
  }
}

TEST(RandomHome, NothingStandsBeforeTheRobot) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = homeOf(seed).scene;
    const FloorPlan floor(scene);
    const Eigen::Rotation2Dd turn(scene.robot.start_yaw_rad);
    for (double x = 0.0; x <= 3.6; x += 0.1) {
      for (double y = -0.9; y <= 0.9; y += 0.1) {
        const Vector2d p = scene.robot.start + turn * Vector2d(x, y);
        ASSERT_GT(floor.clearance(p), kBody_m) << "seed " << seed << ": " << p.transpose();
      }
    }
  }
}

TEST(RandomHome, SomeOfTheFurnitureIsOnNoMap) {
  int mapped = 0, unmapped = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const Furniture& piece : homeOf(seed).scene.furniture) {
      ++(piece.in_map ? mapped : unmapped);
    }
  }
  EXPECT_GT(unmapped, static_cast<int>(kSeeds));
  EXPECT_GT(mapped, unmapped);
}

TEST(RandomEpisode, IsTheSameForTheSameSeedAndNoOther) {
  std::string last;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::string places = placesOf(randomEpisode(seed, scenes()));
    EXPECT_EQ(places, placesOf(randomEpisode(seed, scenes())));
    EXPECT_NE(places, last);
    last = places;
  }
}

TEST(RandomEpisode, PeopleStartAndWalkWhereThereIsRoom) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = randomEpisode(seed, scenes());
    const FloorPlan floor(scene);
    for (const ScenePerson& person : scene.people) {
      const std::string who = "seed " + std::to_string(seed) + ", " + person.name;
      EXPECT_GT(floor.clearance(person.start), kBody_m) << who;
      Vector2d at = person.start;
      for (const PathStep& step : person.path) {
        if (step.kind != PathStep::Kind::kWalk) continue;
        EXPECT_GT(step.speed_mps, 0.2);
        const int parts = 1 + static_cast<int>((step.to - at).norm() / 0.02);
        for (int i = 0; i <= parts; ++i) {
          const Vector2d p = at + (step.to - at) * i / parts;
          ASSERT_GT(floor.clearance(p), kBody_m) << who << " at " << p.transpose();
        }
        at = step.to;
      }
      if (person.repeat) {
        EXPECT_LT((at - person.start).norm(), 0.1) << who << " begins again somewhere else";
      }
    }
  }
}

TEST(RandomEpisode, OnlyThePersonToFollowIsSeenFirst) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = randomEpisode(seed, scenes());
    ASSERT_GE(scene.people.size(), 1U);
    ASSERT_LE(scene.people.size(), 3U);
    const Eigen::Rotation2Dd to_robot(-scene.robot.start_yaw_rad);
    const double view_rad = scene.robot.camera.horizontal_view_rad;
    const Vector2d seen = to_robot * (scene.people[0].start - scene.robot.start);
    EXPECT_GT(std::abs(std::atan2(seen.y(), seen.x())), view_rad / 2.0 + 0.3) << "seed " << seed;
    for (std::size_t i = 1; i < scene.people.size(); ++i) {
      const ScenePerson& other = scene.people[i];
      EXPECT_EQ(other.path.at(0).kind, PathStep::Kind::kWait);
      EXPECT_GT((other.start - scene.robot.start).norm(), 2.0) << "seed " << seed;
      EXPECT_GT((other.start - scene.people[0].start).norm(), 1.0) << "seed " << seed;
    }
  }
}

TEST(RandomEpisode, ThePersonGoesSomewhere) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const ScenePerson person = randomEpisode(seed, scenes()).people.at(0);
    double furthest_m = 0.0;
    for (const PathStep& step : person.path) {
      if (step.kind != PathStep::Kind::kWalk) continue;
      furthest_m = std::max(furthest_m, (step.to - person.start).norm());
    }
    EXPECT_GT(furthest_m, 3.0) << "seed " << seed << ": no visit was possible";
  }
}

TEST(RandomEpisode, ThePersonIsAnybodyAndTheirLikeMayBeAbout) {
  std::set<std::string> targets;
  int beside_their_like = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = randomEpisode(seed, scenes());
    const Wardrobe wardrobe = randomWardrobe(seed);
    std::set<std::string> names;
    for (const ScenePerson& person : scene.people) names.insert(person.name);
    EXPECT_EQ(names.size(), scene.people.size()) << "nobody is there twice";
    targets.insert(scene.people[0].name);
    const std::string& one = wardrobe.people[0].name;
    const std::string& like = wardrobe.people[1].name;
    if (scene.people[0].name == one) beside_their_like += static_cast<int>(names.count(like));
    if (scene.people[0].name == like) beside_their_like += static_cast<int>(names.count(one));
  }
  EXPECT_EQ(targets.size(), 5U);
  EXPECT_GE(beside_their_like, 2);
}

TEST(RandomEpisode, TheLightIsDrawn) {
  EXPECT_TRUE(randomEpisode(1, scenes()).robot.camera.drawn_light);
}

TEST(RandomEpisode, NobodyIsThereToDisturbIfNobodyMayBe) {
  RandomEpisodeParams params;
  params.max_others = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    EXPECT_EQ(randomEpisode(seed, scenes(), params).people.size(), 1U);
  }
}

TEST(RandomEpisode, NamesAFileThatIsMissing) {
  EXPECT_THROW(randomEpisode(1, "/nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace heel
