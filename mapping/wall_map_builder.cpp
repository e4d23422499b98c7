// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOnEdge = 1e-9;  // [m] A middle on a face is in the solid.

/// Cells of one axis, from the first to before the last.
struct CellRange {
  int first = 0;
  int end = 0;
};

octomap::OcTreeKey keyOf(const octomap::OcTree& tree, int x, int y, int z) {
  const auto middle = [&](int i) { return (i + 0.5) * tree.getResolution(); };
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(middle(x), middle(y), middle(z), key)) {
    throw std::invalid_argument("a wall is further away than the map reaches");
  }
  return key;
}

/// Whether there is memory for more: a cell's edge and a wall's height ask for it together.
void checkRoom(const octomap::OcTree& tree) {
  constexpr std::size_t kBytesPerNode = 64;
  checkMemory("a wall map in cells of " + std::to_string(tree.getResolution()) + " m",
              timesAtMost(tree.size(), kBytesPerNode));
}

void setWall(octomap::OcTree& tree, int x, int y, const CellRange& z) {
  for (int i = z.first; i < z.end; ++i) {
    tree.setNodeValue(keyOf(tree, x, y, i), tree.getClampingThresMaxLog(), true);
  }
}

void setFreeFloor(octomap::OcTree& tree, int x, int y) {
  const octomap::OcTreeKey key = keyOf(tree, x, y, 0);
  const octomap::OcTreeNode* node = tree.search(key);
  if (node != nullptr && tree.isNodeOccupied(node)) return;
  tree.setNodeValue(key, tree.getClampingThresMinLog(), true);
}

/// The cells whose middles lie between two heights; at least one.
CellRange layers(const HeightBand& band, double cell_m) {
  const double missing_m = std::max(0.0, cell_m - (band.high_m - band.low_m));
  const double low = (band.low_m - missing_m / 2.0) / cell_m;
  const double high = (band.high_m + missing_m / 2.0) / cell_m;
  CellRange range{static_cast<int>(std::ceil(low - 0.5 - 1e-6)),
                  static_cast<int>(std::floor(high - 0.5 + 1e-6)) + 1};
  if (missing_m > 0.0) range.end = range.first + 1;
  return range;
}

void check(const octomap::OcTree& tree, const Vector2d& center, const Vector2d& size,
           const HeightBand& band) {
  if (!center.allFinite() || !size.allFinite() || !std::isfinite(band.low_m) ||
      !std::isfinite(band.high_m)) {
    throw std::invalid_argument("a wall must be finite");
  }
  if (size.minCoeff() < 0.0 || band.low_m > band.high_m) {
    throw std::invalid_argument("a wall must not have a negative size");
  }
  const double edge_m = 32760.0 * tree.getResolution();
  if (center.cwiseAbs().maxCoeff() + size.norm() > edge_m || std::abs(band.low_m) > edge_m ||
      std::abs(band.high_m) > edge_m) {
    throw std::invalid_argument("a wall is further away than the map reaches");
  }
}

/// Fills the columns within `reach_m` of `center` whose middles are `inside`.
template <typename Inside>
void fill(octomap::OcTree& tree, const Vector2d& center, double reach_m, const HeightBand& band,
          const Inside& inside) {
  const double cell_m = tree.getResolution();
  const CellRange z = layers(band, cell_m);
  const auto cell = [&](double at) { return static_cast<int>(std::floor(at / cell_m)); };
  for (int y = cell(center.y() - reach_m); y <= cell(center.y() + reach_m); ++y) {
    checkRoom(tree);
    for (int x = cell(center.x() - reach_m); x <= cell(center.x() + reach_m); ++x) {
      const Vector2d middle(cell_m * (x + 0.5), cell_m * (y + 0.5));
      if (inside(Vector2d(middle - center))) setWall(tree, x, y, z);
    }
  }
}

}  // namespace

WallMapBuilder::WallMapBuilder(double cell_size_m) {
  if (!(cell_size_m > 0.0) || !std::isfinite(cell_size_m)) {
    throw std::invalid_argument("a wall map's cell size must be positive");
  }
  tree_ = std::make_unique<octomap::OcTree>(cell_size_m);
}

WallMapBuilder::~WallMapBuilder() = default;
WallMapBuilder::WallMapBuilder(WallMapBuilder&&) noexcept = default;
WallMapBuilder& WallMapBuilder::operator=(WallMapBuilder&&) noexcept = default;

void WallMapBuilder::add(const WallBox& box) {
  check(*tree_, box.center, box.size_m, box.band);
  const Eigen::Rotation2Dd to_box(-box.yaw_rad);
  const Vector2d half = (box.size_m / 2.0).cwiseMax(tree_->getResolution() / 2.0);
  fill(*tree_, box.center, half.norm(), box.band, [&](const Vector2d& from_center) {
    const Vector2d beyond = (to_box * from_center).cwiseAbs() - half;
    return beyond.maxCoeff() <= kOnEdge;
  });
}

void WallMapBuilder::add(const WallCylinder& cylinder) {
  check(*tree_, cylinder.center, Vector2d::Constant(cylinder.radius_m), cylinder.band);
  // A disc of this radius holds a cell's middle wherever it stands.
  const double radius_m = std::max(cylinder.radius_m, std::sqrt(0.5) * tree_->getResolution());
  fill(*tree_, cylinder.center, radius_m, cylinder.band,
       [&](const Vector2d& from_center) { return from_center.norm() <= radius_m + kOnEdge; });
}

void WallMapBuilder::addFreeFloor(const Vector2d& low, const Vector2d& high) {
  check(*tree_, low, Vector2d::Zero(), {});
  check(*tree_, high, Vector2d::Zero(), {});
  const double cell_m = tree_->getResolution();
  const auto cell = [&](double at) { return static_cast<int>(std::lround(at / cell_m)); };
  for (int y = cell(low.y()); y < cell(high.y()); ++y) {
    checkRoom(*tree_);
    for (int x = cell(low.x()); x < cell(high.x()); ++x) setFreeFloor(*tree_, x, y);
  }
}

void WallMapBuilder::add(const OccupancyGrid& plan, double height_m) {
  if (plan.empty()) return;
  if (!(height_m > 0.0)) throw std::invalid_argument("walls must have a height");
  const Vector2d size = plan.cell_size_m() * Vector2d(plan.width(), plan.height());
  const HeightBand band{0.0, height_m};
  check(*tree_, plan.origin_m(), size, band);
  const double cell_m = tree_->getResolution();
  const CellRange z = layers(band, cell_m);
  const auto cell = [&](double at) { return static_cast<int>(std::floor(at / cell_m)); };
  // A column is as the plan says at its middle ...
  const Vector2d end = plan.origin_m() + size;
  for (int y = cell(plan.origin_m().y()); y <= cell(end.y()); ++y) {
    checkRoom(*tree_);
    for (int x = cell(plan.origin_m().x()); x <= cell(end.x()); ++x) {
      const Occupancy there = plan.at(Vector2d(cell_m * (x + 0.5), cell_m * (y + 0.5)));
      if (there == Occupancy::kOccupied) setWall(*tree_, x, y, z);
      if (there == Occupancy::kFree) setFreeFloor(*tree_, x, y);
    }
  }
  // ... and wall where a wall of the plan has its middle: what is finer than the map is not lost.
  if (plan.cell_size_m() >= cell_m * (1.0 - 1e-9)) return;
  for (int y = 0; y < plan.height(); ++y) {
    checkRoom(*tree_);
    for (int x = 0; x < plan.width(); ++x) {
      if (plan.at(GridCell{x, y}) != Occupancy::kOccupied) continue;
      const Vector2d middle = plan.center({x, y});
      setWall(*tree_, cell(middle.x()), cell(middle.y()), z);
    }
  }
}

void WallMapBuilder::add(const std::vector<Eigen::Vector3f>& points_m,
                         const Eigen::Isometry3d& T_world_camera, double max_range_m) {
  if (!(max_range_m > 0.0)) throw std::invalid_argument("a camera's range must be positive");
  octomap::Pointcloud cloud;
  cloud.reserve(points_m.size());
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  for (const Eigen::Vector3f& point : points_m) {
    if (!point.allFinite()) continue;
    const Eigen::Vector3f p = T * point;
    cloud.push_back(p.x(), p.y(), p.z());
  }
  const Eigen::Vector3f eye = T.translation();
  // Lazy: inner nodes are stale until build() updates them once.
  tree_->insertPointCloud(cloud, {eye.x(), eye.y(), eye.z()}, max_range_m, true, true);
}

WallMap WallMapBuilder::build() {
  auto done = std::make_unique<octomap::OcTree>(tree_->getResolution());
  std::swap(done, tree_);
  done->updateInnerOccupancy();
  done->prune();
  return WallMap(std::shared_ptr<const octomap::OcTree>(std::move(done)));
}

}  // namespace heel
