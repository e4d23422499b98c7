// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heel {
namespace {

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
  if (high < kDrivesOver_m) return;
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

namespace {

/// Marks as free what can be reached over unknown cells.
void fillFree(const GridCell& start, OccupancyGrid& grid) {
  if (!grid.contains(start) || grid.at(start) != Occupancy::kUnknown) return;
  std::vector<GridCell> open{start};
  grid.at(start) = Occupancy::kFree;
  while (!open.empty()) {
    const GridCell c = open.back();
    open.pop_back();
    for (const GridCell next : {GridCell{c.x + 1, c.y}, GridCell{c.x - 1, c.y},
                                GridCell{c.x, c.y + 1}, GridCell{c.x, c.y - 1}}) {
      if (!grid.contains(next) || grid.at(next) != Occupancy::kUnknown) continue;
      grid.at(next) = Occupancy::kFree;
      open.push_back(next);
    }
  }
}

}  // namespace

OccupancyGrid sceneGrid(const Scene& scene, const SceneGridParams& params) {
  const FloorBounds bounds = floorBounds(scene);
  const Eigen::Vector2d origin = bounds.low.array() - params.margin_m;
  const Eigen::Vector2d size = (bounds.high - bounds.low).array() + 2.0 * params.margin_m;
  OccupancyGrid grid(
      origin, params.cell_size_m, static_cast<int>(std::ceil(size.x() / params.cell_size_m)),
      static_cast<int>(std::ceil(size.y() / params.cell_size_m)), Occupancy::kUnknown);
  const FloorPlan plan(scene, true, std::max(params.low_m, kDrivesOver_m), params.high_m);
  for (GridCell c; c.y < grid.height(); ++c.y) {
    for (c.x = 0; c.x < grid.width(); ++c.x) {
      if (plan.clearance(grid.center(c)) < 0.0) grid.at(c) = Occupancy::kOccupied;
    }
  }
  fillFree(grid.cellAt(scene.robot.start), grid);
  return grid;
}

OccupancyGrid laserGrid(const Scene& scene, double cell_size_m) {
  SceneGridParams params;
  params.cell_size_m = cell_size_m;
  params.low_m = params.high_m = scene.robot.laser.at.z();
  return sceneGrid(scene, params);
}

}  // namespace heel
