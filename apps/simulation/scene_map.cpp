// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <cmath>

namespace heel {
namespace {

constexpr double kFlat_m = 0.03;  // Lower than this one walks over it.

void addWall(WallMapBuilder& builder, const Wall& wall) {
  const Eigen::Vector2d along = (wall.to - wall.from).normalized();
  for (const WallPiece& piece : wallPieces(wall)) {
    WallBox box;
    box.center = wall.from + along * (piece.from_m + piece.to_m) / 2.0;
    box.yaw_rad = std::atan2(along.y(), along.x());
    box.size_m = {piece.to_m - piece.from_m, wall.thickness_m};
    box.band = {piece.low_m, piece.high_m};
    builder.add(box);
  }
}

void addPart(WallMapBuilder& builder, const FurniturePart& part) {
  const bool is_box = part.shape == FurniturePart::Shape::kBox;
  const double low = part.base.z(), high = low + (is_box ? part.size_m.z() : part.height_m);
  if (high < kFlat_m) return;
  if (is_box) {
    builder.add(
        WallBox{part.base.head<2>(), part.yaw_rad, part.size_m.head<2>(), HeightBand{low, high}});
  } else {
    builder.add(WallCylinder{part.base.head<2>(), part.radius_m, HeightBand{low, high}});
  }
}

}  // namespace

WallMap wallMapOf(const Scene& scene, double cell_size_m) {
  WallMapBuilder builder(cell_size_m);
  const FloorBounds flat = floorBounds(scene);
  builder.addFreeFloor(flat.low, flat.high);
  for (const Wall& wall : scene.walls) addWall(builder, wall);
  for (const Furniture& piece : scene.furniture) {
    if (!piece.in_map) continue;
    for (const FurniturePart& part : piece.parts) addPart(builder, part);
  }
  return builder.build();
}

}  // namespace heel
