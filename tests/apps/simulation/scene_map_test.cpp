// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/scene_map.hpp>

#include <gtest/gtest.h>

#include <string>

namespace heel {
namespace {

TEST(SceneMap, IsTheFloorPlanInCells) {
  for (const char* name : {"home", "office", "wardrobe", "corridor"}) {
    const Scene scene = loadScene(std::string(HEEL_SCENES) + "/" + name + ".yaml");
    const FloorPlan plan(scene, true);
    const OccupancyGrid map = wallMapOf(scene).floorGrid({0.03, 1.9});
    const FloorBounds flat = floorBounds(scene);
    for (double x = flat.low.x() + 0.1; x < flat.high.x(); x += 0.23) {
      for (double y = flat.low.y() + 0.1; y < flat.high.y(); y += 0.19) {
        const double truth = plan.clearance({x, y});
        if (truth < 0.0) continue;
        EXPECT_FALSE(map.isOccupiedWithin({x, y}, truth - 0.055)) << name << " " << x << " " << y;
        EXPECT_TRUE(map.isOccupiedWithin({x, y}, truth + 0.055)) << name << " " << x << " " << y;
      }
    }
  }
}

TEST(SceneMap, LeavesOutWhatTheRobotDoesNotKnow) {
  Scene scene = loadScene(std::string(HEEL_SCENES) + "/home.yaml");
  Furniture box;
  box.parts.resize(1);
  box.parts[0].base = {2.0, 2.5, 0.0};
  scene.furniture = {box};
  EXPECT_TRUE(wallMapOf(scene).isWall({2.0, 2.5, 0.5}));
  scene.furniture[0].in_map = false;
  EXPECT_FALSE(wallMapOf(scene).isWall({2.0, 2.5, 0.5}));
}

TEST(SceneMap, HasDoorwaysWithWallsOverThem) {
  const WallMap map = wallMapOf(loadScene(std::string(HEEL_SCENES) + "/home.yaml"));
  EXPECT_TRUE(map.lineOfSight({4.5, 4.0, 1.0}, {5.9, 4.0, 1.0})) << "living room to hall";
  EXPECT_FALSE(map.lineOfSight({4.5, 4.0, 2.3}, {5.9, 4.0, 2.3})) << "over the doorway";
  EXPECT_FALSE(map.lineOfSight({4.5, 2.5, 2.3}, {5.9, 2.5, 2.3}));
}

}  // namespace
}  // namespace heel
