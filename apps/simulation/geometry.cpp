// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/geometry.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// Adds shapes to a geometry.
class Builder {
 public:
  explicit Builder(Geometry& geometry) : geometry_(geometry) {}

  void face(const Vector3d& origin, const Vector3d& u, const Vector3d& v, const Surface& surface,
            double texture_u_m = 0.0) {
    geometry_.faces.push_back({origin.cast<float>(), u.cast<float>(), v.cast<float>(),
                               u.cross(v).normalized().cast<float>(),
                               geometry_.materials.indexOf(surface.material), surface.color,
                               static_cast<float>(texture_u_m)});
  }

  /// A box that stands on `base`; surfaces of its left (+y), right (-y) and other sides.
  void box(const Vector3d& base, const Vector3d& size, double yaw, const Surface& left,
           const Surface& right, const Surface& other, double texture_u_m = 0.0) {
    const Vector3d x = size.x() * Vector3d(std::cos(yaw), std::sin(yaw), 0.0);
    const Vector3d y = size.y() * Vector3d(-std::sin(yaw), std::cos(yaw), 0.0);
    const Vector3d z(0.0, 0.0, size.z());
    const Vector3d corner = base - x / 2 - y / 2;
    face(corner + x + y, -x, z, left, -texture_u_m - size.x());
    face(corner, x, z, right, texture_u_m);
    face(corner + x, y, z, other);
    face(corner + y, -y, z, other);
    // Wood and cloth run along the longer side of a table top or a seat.
    if (size.y() > size.x()) {
      face(corner + x + z, y, -x, other);
    } else {
      face(corner + z, x, y, other);
    }
    face(corner + y, x, -y, other);
  }

  void pillar(const Vector3d& base, double radius_m, double height_m, const Surface& surface) {
    geometry_.pillars.push_back({base.cast<float>(), static_cast<float>(radius_m),
                                 static_cast<float>(height_m),
                                 geometry_.materials.indexOf(surface.material), surface.color});
  }

 private:
  Geometry& geometry_;
};

void addWall(const Wall& wall, Builder& build) {
  const Vector2d along = (wall.to - wall.from).normalized();
  const double yaw = std::atan2(along.y(), along.x());
  const Surface board{"gloss", Rgb(0.62F, 0.6F, 0.56F)};
  for (const WallPiece& piece : wallPieces(wall)) {
    const double length = piece.to_m - piece.from_m;
    const Vector2d middle = wall.from + along * (piece.from_m + piece.to_m) / 2;
    const Vector3d base(middle.x(), middle.y(), piece.low_m);
    build.box(base, {length, wall.thickness_m, piece.high_m - piece.low_m}, yaw, wall.left,
              wall.right, wall.left, piece.from_m);
    if (wall.skirting_m > 0.0 && piece.low_m <= 0.0) {
      build.box(base, {length + 0.002, wall.thickness_m + 0.024, wall.skirting_m}, yaw, board,
                board, board);
    }
  }
}

void addWindow(const Light& light, Builder& build) {
  const Vector3d into(std::cos(light.facing_rad), std::sin(light.facing_rad), 0.0);
  const Vector3d along(-into.y(), into.x(), 0.0);
  const Vector3d up(0.0, 0.0, 1.0);
  build.face(light.at - along * light.width_m / 2 - up * light.height_m / 2 + into * 0.004,
             along * light.width_m, up * light.height_m, {"outdoors", light.color});
  const Surface frame{"gloss", Rgb(0.75F, 0.75F, 0.73F)};
  for (const double side : {-0.5, 0.0, 0.5}) {  // Posts and the middle bar.
    const Vector3d base =
        light.at + along * side * light.width_m - up * (light.height_m / 2 + 0.04);
    build.box(base, {0.05, 0.05, light.height_m + 0.08}, light.facing_rad, frame, frame, frame);
  }
  for (const double side : {-0.5, 0.5}) {  // Sill and head.
    const Vector3d base = light.at + up * (side * light.height_m - 0.03);
    build.box(base, {side < 0 ? 0.16 : 0.05, light.width_m + 0.04, 0.05}, light.facing_rad, frame,
              frame, frame);
  }
}

void addFurniture(const FurniturePart& part, Builder& build) {
  if (part.shape == FurniturePart::Shape::kCylinder) {
    build.pillar(part.base, part.radius_m, part.height_m, part.surface);
    return;
  }
  build.box(part.base, part.size_m, part.yaw_rad, part.surface, part.surface, part.surface);
}

// What is left of rectangles without a part of them.
std::vector<FloorArea> cutOut(const std::vector<FloorArea>& areas, const FloorArea& hole) {
  std::vector<FloorArea> left;
  for (const FloorArea& area : areas) {
    const Vector2d low = area.low.cwiseMax(hole.low), high = area.high.cwiseMin(hole.high);
    if (!((high - low).minCoeff() > 0.0)) {
      left.push_back(area);
      continue;
    }
    const auto keep = [&](double x0, double y0, double x1, double y1) {
      FloorArea piece = area;
      piece.low = {x0, y0};
      piece.high = {x1, y1};
      if ((piece.high - piece.low).minCoeff() > 0.0) left.push_back(piece);
    };
    keep(area.low.x(), area.low.y(), low.x(), area.high.y());
    keep(high.x(), area.low.y(), area.high.x(), area.high.y());
    keep(low.x(), area.low.y(), high.x(), low.y());
    keep(low.x(), high.y(), high.x(), area.high.y());
  }
  return left;
}

void addFloor(const FloorArea& area, double height_m, const Scene& scene, Builder& build) {
  std::vector<FloorArea> pieces{area};
  for (const FloorArea& hole : scene.floor_areas) {
    if (hole.depth_m > 0.0) pieces = cutOut(pieces, hole);
  }
  for (const FloorArea& piece : pieces) {
    const Vector2d size = piece.high - piece.low;
    build.face({piece.low.x(), piece.low.y(), height_m}, {size.x(), 0.0, 0.0}, {0.0, size.y(), 0.0},
               piece.surface, piece.low.x() - area.low.x());
  }
}

void addStepDown(const FloorArea& area, Builder& build) {
  const Vector3d corner(area.low.x(), area.low.y(), -area.depth_m), up(0.0, 0.0, area.depth_m);
  const Vector3d x(area.high.x() - area.low.x(), 0.0, 0.0),
      y(0.0, area.high.y() - area.low.y(), 0.0);
  build.face(corner, x, y, area.surface);
  build.face(corner, y, up, area.surface);
  build.face(corner + x + y, -y, up, area.surface);
  build.face(corner + x, -x, up, area.surface);
  build.face(corner + y, x, up, area.surface);
}

}  // namespace

Geometry makeGeometry(const Scene& scene) {
  Geometry geometry;
  Builder build(geometry);
  const FloorBounds flat = floorBounds(scene);
  const double margin = 2.0;
  const Vector3d corner(flat.low.x() - margin, flat.low.y() - margin, 0.0);
  const Vector3d x(flat.high.x() - flat.low.x() + 2 * margin, 0.0, 0.0);
  const Vector3d y(0.0, flat.high.y() - flat.low.y() + 2 * margin, 0.0);
  FloorArea all;
  all.low = corner.head<2>();
  all.high = (corner + x + y).head<2>();
  all.surface = scene.floor;
  addFloor(all, 0.0, scene, build);
  if (scene.ceiling_m > 0.0) {
    build.face(corner + y + Vector3d(0.0, 0.0, scene.ceiling_m), x, -y, scene.ceiling);
  }
  double height = 0.0;
  for (const FloorArea& area : scene.floor_areas) {
    if (area.depth_m > 0.0) {
      addStepDown(area, build);
      continue;
    }
    height += 0.002;  // Each lies on those before it.
    addFloor(area, height, scene, build);
  }
  for (const Wall& wall : scene.walls) addWall(wall, build);
  for (const Furniture& piece : scene.furniture) {
    for (const FurniturePart& part : piece.parts) addFurniture(part, build);
  }
  for (const Light& light : scene.lights) {
    if (light.kind == Light::Kind::kWindow) {
      addWindow(light, build);
    } else {
      build.pillar(light.at - Vector3d(0.0, 0.0, 0.04), light.radius_m, 0.08,
                   {"lamp", light.color});
    }
  }
  return geometry;
}

}  // namespace heel
