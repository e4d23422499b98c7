// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/doorways.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

/// A map of 5 cm cells with a wall around it.
OccupancyGrid emptyMap(double width_m, double height_m) {
  OccupancyGrid map({0.0, 0.0}, 0.05, static_cast<int>(std::lround(width_m / 0.05)),
                    static_cast<int>(std::lround(height_m / 0.05)));
  for (int x = 0; x < map.width(); ++x) {
    map.at(GridCell{x, 0}) = map.at(GridCell{x, map.height() - 1}) = Occupancy::kOccupied;
  }
  for (int y = 0; y < map.height(); ++y) {
    map.at(GridCell{0, y}) = map.at(GridCell{map.width() - 1, y}) = Occupancy::kOccupied;
  }
  return map;
}

void draw(OccupancyGrid& map, const Vector2d& low, const Vector2d& high,
          Occupancy what = Occupancy::kOccupied) {
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Vector2d p = map.center({x, y});
      if ((p - low).minCoeff() > 0.0 && (high - p).minCoeff() > 0.0) map.at(GridCell{x, y}) = what;
    }
  }
}

/// The doorway of `found` that is within 0.15 m of a place; null if there is none.
const DoorwayOnMap* near(const std::vector<DoorwayOnMap>& found, const Vector2d& place) {
  for (const DoorwayOnMap& door : found) {
    if ((door.center - place).norm() < 0.15) return &door;
  }
  return nullptr;
}

TEST(Doorways, FindsAGapInAWallWithItsWidthAndDirection) {
  for (const double width : {0.7, 0.8, 0.9, 1.0}) {
    OccupancyGrid map = emptyMap(6.0, 4.0);
    draw(map, {2.9, 0.0}, {3.05, 2.0 - width / 2});
    draw(map, {2.9, 2.0 + width / 2}, {3.05, 4.0});
    const auto found = findDoorways(map);
    ASSERT_EQ(found.size(), 1U) << width;
    EXPECT_NEAR(found[0].center.x(), 2.975, 0.06);
    EXPECT_NEAR(found[0].center.y(), 2.0, 0.06);
    EXPECT_NEAR(found[0].width_m, width, 0.1);
    EXPECT_GT(std::abs(found[0].through.x()), 0.98);
  }
}

TEST(Doorways, FindsASlantedOne) {
  OccupancyGrid map = emptyMap(6.0, 6.0);
  const Vector2d along = Vector2d(1.0, 1.0).normalized(), across(-along.y(), along.x());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Vector2d off = map.center({x, y}) - Vector2d(3.0, 3.0);
      if (std::abs(off.dot(across)) < 0.1 && std::abs(off.dot(along)) > 0.45) {
        map.at(GridCell{x, y}) = Occupancy::kOccupied;
      }
    }
  }
  const auto found = findDoorways(map);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found[0].center - Vector2d(3.0, 3.0)).norm(), 0.12);
  EXPECT_GT(std::abs(found[0].through.dot(across)), 0.95);
  EXPECT_NEAR(found[0].width_m, 0.9, 0.12);
}

TEST(Doorways, AGapBesideFurnitureIsNone) {
  OccupancyGrid map = emptyMap(6.0, 4.0);
  draw(map, {2.5, 0.9}, {3.5, 2.2});  // A table, 0.85 m from the wall.
  EXPECT_TRUE(findDoorways(map).empty());
}

TEST(Doorways, ANookIsNone) {
  OccupancyGrid map = emptyMap(6.0, 4.0);
  draw(map, {2.5, 3.0}, {2.7, 4.0});
  draw(map, {3.5, 3.0}, {3.7, 4.0});
  EXPECT_TRUE(findDoorways(map).empty());
}

TEST(Doorways, TheUnknownIsAsAWall) {
  OccupancyGrid map = emptyMap(6.0, 4.0);
  draw(map, {2.9, 0.0}, {3.05, 4.0}, Occupancy::kUnknown);
  draw(map, {2.9, 1.6}, {3.05, 2.4}, Occupancy::kFree);
  EXPECT_EQ(findDoorways(map).size(), 1U);
}

TEST(Doorways, AnEmptyRoomAndAFullOneHaveNone) {
  EXPECT_TRUE(findDoorways(emptyMap(6.0, 4.0)).empty());
  EXPECT_TRUE(findDoorways({{0.0, 0.0}, 0.05, 40, 40, Occupancy::kOccupied}).empty());
  EXPECT_THROW(findDoorways(OccupancyGrid()), std::invalid_argument);
  DoorwayParams params;
  params.max_width_m = 0.1;
  EXPECT_THROW(findDoorways(emptyMap(2.0, 2.0), params), std::invalid_argument);
}

// The walls of the `home` scene, 0.12 m thick, and its larger furniture.
TEST(Doorways, FindsThoseOfAFlatWithAHall) {
  OccupancyGrid map = emptyMap(10.0, 8.0);
  const auto upright = [&](double x, double y0, double y1) {
    draw(map, {x - 0.06, y0}, {x + 0.06, y1});
  };
  const auto level = [&](double y, double x0, double x1) {
    draw(map, {x0, y - 0.06}, {x1, y + 0.06});
  };
  upright(5.2, 0.0, 3.5);
  upright(5.2, 4.5, 4.6);
  level(4.6, 0.0, 1.95);
  level(4.6, 2.85, 5.75);
  level(4.6, 6.65, 8.05);
  level(4.6, 8.95, 10.0);
  level(3.4, 5.2, 6.3);
  level(3.4, 7.3, 10.0);
  upright(4.0, 4.6, 8.0);
  upright(7.0, 4.6, 8.0);
  draw(map, {1.7, 0.1}, {3.7, 1.0});   // sofa
  draw(map, {0.6, 4.2}, {1.4, 4.54});  // bookshelf
  draw(map, {4.6, 1.7}, {5.1, 2.7});   // cupboard
  draw(map, {5.4, 0.1}, {9.3, 0.7});   // kitchen
  draw(map, {8.1, 1.8}, {9.5, 2.6});   // table
  draw(map, {0.2, 6.1}, {2.2, 7.9});   // bed
  draw(map, {3.3, 6.6}, {3.9, 7.7});   // wardrobe
  draw(map, {4.8, 7.2}, {6.2, 7.9});   // desk
  draw(map, {9.1, 6.0}, {9.9, 7.9});   // tub
  const auto found = findDoorways(map);
  for (const Vector2d& place :
       {Vector2d(2.4, 4.6), Vector2d(6.2, 4.6), Vector2d(8.5, 4.6), Vector2d(6.8, 3.4)}) {
    const DoorwayOnMap* door = near(found, place);
    ASSERT_NE(door, nullptr) << place.transpose();
    EXPECT_GT(std::abs(door->through.y()), 0.98);
  }
  const DoorwayOnMap* hall = near(found, {5.2, 4.0});
  ASSERT_NE(hall, nullptr);
  EXPECT_GT(std::abs(hall->through.x()), 0.98);
  EXPECT_EQ(found.size(), 5U);
  for (const DoorwayOnMap& door : found) {
    SCOPED_TRACE(testing::Message() << door.center.transpose() << " width " << door.width_m);
    EXPECT_GT(door.width_m, 0.8);
  }
}

}  // namespace
}  // namespace heel
