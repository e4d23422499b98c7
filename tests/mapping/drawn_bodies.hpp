// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Upright shapes over the floor in closed form, as the truth for body checks.
#pragma once

#include <heel/mapping/body_check.hpp>

#include <Eigen/Geometry>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace heel::test {

/// A box in space, along the world's axes.
struct DrawnBox {
  Eigen::Vector3d low, high;
};

/// From a point to a segment.
inline double toSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double part = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - a - part * way).norm();
}

using Corners = std::array<Eigen::Vector2d, 4>;

inline bool inside(const Corners& corners, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % 4] - corners[i];
    const Eigen::Vector2d to = p - corners[i];
    if (side.x() * to.y() - side.y() * to.x() < 0.0) return false;
  }
  return true;
}

/// Between two rectangles, corners anticlockwise; 0 if they overlap.
inline double between(const Corners& a, const Corners& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    if (inside(a, b[i]) || inside(b, a[i])) return 0.0;
    const Eigen::Vector2d& a1 = a[(i + 1) % 4];
    for (std::size_t j = 0; j < 4; ++j) {
      const Eigen::Vector2d& b1 = b[(j + 1) % 4];
      nearest = std::min({nearest, toSegment(b[j], a[i], a1), toSegment(a[i], b[j], b1)});
      // Sides that cross without a corner inside.
      const auto side = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                           const Eigen::Vector2d& r) {
        return (q - p).x() * (r - p).y() - (q - p).y() * (r - p).x();
      };
      if (side(a[i], a1, b[j]) * side(a[i], a1, b1) < 0.0 &&
          side(b[j], b1, a[i]) * side(b[j], b1, a1) < 0.0) {
        return 0.0;
      }
    }
  }
  return nearest;
}

inline Corners cornersOf(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return {low, Eigen::Vector2d(high.x(), low.y()), high, Eigen::Vector2d(low.x(), high.y())};
}

/// From a body to a box, in space.
inline double drawnClearance(const RobotBody& body, const FloorPose& pose, const DrawnBox& box) {
  const Corners floor = cornersOf(box.low.head<2>(), box.high.head<2>());
  double flat = 0.0;
  if (const auto* round = std::get_if<RoundFootprint>(&body.footprint)) {
    const Eigen::Vector2d nearest =
        pose.position.cwiseMax(box.low.head<2>()).cwiseMin(box.high.head<2>());
    flat = std::max(0.0, (nearest - pose.position).norm() - round->radius_m);
  } else {
    const auto& footprint = std::get<BoxFootprint>(body.footprint);
    const Eigen::Vector2d half(footprint.length_m / 2.0, footprint.width_m / 2.0);
    const Eigen::Vector2d ahead(footprint.ahead_m, 0.0);
    Corners corners = cornersOf(ahead - half, ahead + half);
    for (auto& corner : corners) corner = pose * corner;
    flat = between(corners, floor);
  }
  const double above = std::max({0.0, box.low.z() - body.top_m, body.bottom_m - box.high.z()});
  return std::hypot(flat, above);
}

/// The least of all; infinite without any.
inline double drawnClearance(const RobotBody& body, const FloorPose& pose,
                             const std::vector<DrawnBox>& boxes) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const DrawnBox& box : boxes) nearest = std::min(nearest, drawnClearance(body, pose, box));
  return nearest;
}

/// The occupied leaves of a tree.
inline std::vector<DrawnBox> occupiedBoxes(const octomap::OcTree& tree) {
  std::vector<DrawnBox> boxes;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const Eigen::Vector3d middle(leaf.getX(), leaf.getY(), leaf.getZ());
    boxes.push_back({middle.array() - leaf.getSize() / 2, middle.array() + leaf.getSize() / 2});
  }
  return boxes;
}

/// Occupies all voxels whose middle is in the box.
inline void drawWall(octomap::OcTree& tree, const DrawnBox& box) {
  const double step = tree.getResolution();
  for (double x = box.low.x() + step / 2; x < box.high.x(); x += step) {
    for (double y = box.low.y() + step / 2; y < box.high.y(); y += step) {
      for (double z = box.low.z() + step / 2; z < box.high.z(); z += step) {
        tree.setNodeValue(x, y, z, tree.getClampingThresMaxLog());
      }
    }
  }
}

/// A room of 6 x 6 m around the origin with random pillars and overhanging boards.
inline octomap::OcTree drawRoom(unsigned seed, double resolution_m) {
  octomap::OcTree tree(resolution_m);
  drawWall(tree, {{-3.0, -3.0, 0.0}, {3.0, -2.8, 2.0}});
  drawWall(tree, {{-3.0, 2.8, 0.0}, {3.0, 3.0, 2.0}});
  drawWall(tree, {{-3.0, -3.0, 0.0}, {-2.8, 3.0, 2.0}});
  drawWall(tree, {{2.8, -3.0, 0.0}, {3.0, 3.0, 2.0}});
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(-25, 24);
  const auto snapped = [&] { return 0.1 * place(random); };
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d low(snapped(), snapped(), 0.0);
    drawWall(tree, {low, low + Eigen::Vector3d(0.2, 0.3, 2.0)});
    const Eigen::Vector3d board(snapped(), snapped(), 0.7);
    drawWall(tree, {board, board + Eigen::Vector3d(0.8, 0.4, 0.1)});
    const Eigen::Vector3d lintel(snapped(), snapped(), 1.5);
    drawWall(tree, {lintel, lintel + Eigen::Vector3d(0.8, 0.4, 0.1)});
  }
  tree.prune();
  return tree;
}

}  // namespace heel::test
