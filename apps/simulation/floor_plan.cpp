// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

double distanceTo(const FloorBox& box, const Eigen::Vector2d& p) {
  const Eigen::Vector2d d = p - box.center;
  const Eigen::Vector2d side(box.axis.x() * d.x() + box.axis.y() * d.y(),
                             box.axis.x() * d.y() - box.axis.y() * d.x());
  const Eigen::Vector2d beyond = side.cwiseAbs() - box.half;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

}  // namespace

std::vector<WallPiece> wallPieces(const Wall& wall) {
  // A millimetre short of the other wall's face, so that no two faces lie in one plane.
  const double overlap = wall.thickness_m / 2 - 0.001;
  const double length = (wall.to - wall.from).norm();
  std::vector<WallPiece> pieces;
  double from = -overlap;
  for (const Doorway& door : wall.doors) {
    const double low = door.at_m - door.width_m / 2, high = door.at_m + door.width_m / 2;
    if (low > from) pieces.push_back({from, low, 0.0, wall.height_m});
    if (door.height_m < wall.height_m) pieces.push_back({low, high, door.height_m, wall.height_m});
    from = high;
  }
  pieces.push_back({from, length + overlap, 0.0, wall.height_m});
  return pieces;
}

FloorPlan::FloorPlan(const Scene& scene, bool only_mapped, double low_m, double high_m) {
  for (const Wall& wall : scene.walls) {
    const Eigen::Vector2d along = (wall.to - wall.from).normalized();
    for (const WallPiece& piece : wallPieces(wall)) {
      if (piece.low_m > high_m) continue;
      boxes_.push_back({wall.from + along * (piece.from_m + piece.to_m) / 2,
                        along,
                        {(piece.to_m - piece.from_m) / 2, wall.thickness_m / 2}});
    }
  }
  for (const FloorArea& area : scene.floor_areas) {
    if (only_mapped || area.depth_m < low_m) continue;
    boxes_.push_back(
        {0.5 * (area.low + area.high), Eigen::Vector2d::UnitX(), 0.5 * (area.high - area.low)});
  }
  for (const Furniture& piece : scene.furniture) {
    if (only_mapped && !piece.in_map) continue;
    for (const FurniturePart& part : piece.parts) {
      const bool is_box = part.shape == FurniturePart::Shape::kBox;
      const double high = part.base.z() + (is_box ? part.size_m.z() : part.height_m);
      if (high < low_m || part.base.z() > high_m) continue;
      if (is_box) {
        boxes_.push_back({part.base.head<2>(),
                          {std::cos(part.yaw_rad), std::sin(part.yaw_rad)},
                          part.size_m.head<2>() / 2});
      } else {
        discs_.push_back({part.base.head<2>(), part.radius_m});
      }
    }
  }
}

double FloorPlan::clearance(const Eigen::Vector2d& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const FloorBox& box : boxes_) least = std::min(least, distanceTo(box, p));
  for (const FloorDisc& disc : discs_) {
    least = std::min(least, (p - disc.center).norm() - disc.radius_m);
  }
  return least;
}

FloorBounds floorBounds(const Scene& scene) {
  if (scene.walls.empty()) return {{-5.0, -5.0}, {5.0, 5.0}};
  FloorBounds bounds{scene.walls[0].from, scene.walls[0].from};
  for (const Wall& wall : scene.walls) {
    for (const Eigen::Vector2d& end : {wall.from, wall.to}) {
      bounds.low = bounds.low.cwiseMin(end);
      bounds.high = bounds.high.cwiseMax(end);
    }
  }
  return bounds;
}

}  // namespace heel
