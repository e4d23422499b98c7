// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/mapping/wall_map.hpp>

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouch = 1e-3;  // Of a cell: less than this is touching, not overlapping.

octomap::point3d toOctomap(const Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

bool isWallAt(const octomap::OcTree& tree, const Vector3d& point) {
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(toOctomap(point), key)) return false;
  const octomap::OcTreeNode* node = tree.search(key);
  return node != nullptr && tree.isNodeOccupied(node);
}

/// How far a ray goes before it leaves what a tree can hold; OctoMap would print a warning there.
double lengthInTree(const octomap::OcTree& tree, const Vector3d& from, const Vector3d& direction) {
  const double edge_m = 32760.0 * tree.getResolution();
  if (from.cwiseAbs().maxCoeff() >= edge_m) return -1.0;
  double length_m = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) continue;
    length_m = std::min(length_m, (std::copysign(edge_m, direction[i]) - from[i]) / direction[i]);
  }
  return length_m;
}

/// How far it is to a cell's nearer faces along a ray that hits it.
double entry(const Vector3d& from, const Vector3d& direction, const octomap::point3d& center,
             double cell_m) {
  double entry_m = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) < 1e-9) continue;
    const double face = static_cast<double>(center(static_cast<unsigned>(i))) -
                        std::copysign(cell_m / 2.0, direction[i]);
    entry_m = std::max(entry_m, (face - from[i]) / direction[i]);
  }
  return entry_m;
}

}  // namespace

WallMap::WallMap(std::shared_ptr<const octomap::OcTree> tree) : tree_(std::move(tree)) {
  if (tree_ == nullptr) throw std::invalid_argument("WallMap: there is no tree");
}

double WallMap::cell_size_m() const { return tree_->getResolution(); }

bool WallMap::isWall(const Vector3d& point) const {
  return point.allFinite() && isWallAt(*tree_, point);
}

double WallMap::firstWall(const Vector3d& from, const Vector3d& to) const {
  if (!from.allFinite() || !to.allFinite()) return 0.0;
  const Vector3d way = to - from;
  const double distance_m = way.norm();
  if (distance_m < 1e-6) return isWallAt(*tree_, from) ? 0.0 : kInfinity;
  const Vector3d direction = way / distance_m;
  // castRay measures to the cells' middles: it must look as far as those of the last ones.
  const double reach_m =
      std::min(distance_m + cell_size_m(), lengthInTree(*tree_, from, direction));
  if (reach_m <= 0.0) return kInfinity;
  octomap::point3d hit;
  // Unknown cells are passed (the `true`): with false, a ray ends at the first and reports no hit.
  if (!tree_->castRay(toOctomap(from), toOctomap(direction), hit, true, reach_m)) return kInfinity;
  const double hit_m = entry(from, direction, hit, cell_size_m());
  return hit_m <= distance_m ? hit_m : kInfinity;
}

bool WallMap::lineOfSight(const Vector3d& from, const Vector3d& to, double margin_m) const {
  if (!from.allFinite() || !to.allFinite()) return false;
  return firstWall(from, to) >= (to - from).norm() - margin_m;
}

/// What the tree spans of the floor, in cells from the origin.
Eigen::AlignedBox2i WallMap::floorCells() const {
  double low[3], high[3];
  tree_->getMetricMin(low[0], low[1], low[2]);
  tree_->getMetricMax(high[0], high[1], high[2]);
  const auto cell = [&](double at) { return static_cast<int>(std::lround(at / cell_size_m())); };
  return {Eigen::Vector2i(cell(low[0]), cell(low[1])),
          Eigen::Vector2i(cell(high[0]), cell(high[1]))};
}

std::size_t WallMap::floorBytes() const {
  constexpr std::size_t kBytesPerCell = 32;  // with the distances that are made of it
  if (tree_->size() == 0) return 0;
  const Eigen::Vector2i size = floorCells().sizes();
  return timesAtMost(kBytesPerCell, timesAtMost(static_cast<std::size_t>(size.x()),
                                                static_cast<std::size_t>(size.y())));
}

OccupancyGrid WallMap::floorGrid(const HeightBand& band) const {
  if (!(band.low_m < band.high_m)) {
    throw std::invalid_argument("a height band's low must be under its high");
  }
  if (tree_->size() == 0) return {};
  checkMemory("the floor of the map", floorBytes());
  const Eigen::AlignedBox2i span = floorCells();
  const double cell_m = cell_size_m();
  const Vector2d origin = cell_m * span.min().cast<double>();
  OccupancyGrid grid(origin, cell_m, span.sizes().x(), span.sizes().y(), Occupancy::kUnknown);
  const auto layer = [&](double height_m, double round) {
    return static_cast<int>(std::ceil(height_m / cell_m + round));
  };
  const bool is_thin = band.high_m - band.low_m < cell_m;
  const int low = layer(band.low_m, is_thin ? kTouch - 1.0 : -kTouch);
  const int high = layer(band.high_m, -kTouch);
  for (auto leaf = tree_->begin_leafs(); leaf != tree_->end_leafs(); ++leaf) {
    const auto cells = static_cast<int>(std::lround(leaf.getSize() / cell_m));
    const auto z0 = static_cast<int>(std::lround((leaf.getZ() - leaf.getSize() / 2.0) / cell_m));
    const bool is_in_band = z0 < high && z0 + cells > low;
    const bool is_wall = tree_->isNodeOccupied(*leaf);
    const bool is_on_floor = z0 < 1 && z0 + cells > 0;
    if (!is_in_band && (is_wall || !is_on_floor)) continue;
    const auto x0 =
        static_cast<int>(std::lround((leaf.getX() - leaf.getSize() / 2.0 - origin.x()) / cell_m));
    const auto y0 =
        static_cast<int>(std::lround((leaf.getY() - leaf.getSize() / 2.0 - origin.y()) / cell_m));
    for (int y = y0; y < y0 + cells; ++y) {
      for (int x = x0; x < x0 + cells; ++x) {
        Occupancy& cell = grid.at(GridCell{x, y});
        if (cell != Occupancy::kOccupied) cell = is_wall ? Occupancy::kOccupied : Occupancy::kFree;
      }
    }
  }
  return grid;
}

}  // namespace heel
