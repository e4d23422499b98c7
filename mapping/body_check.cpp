// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/body_check.hpp>
#include <heel/mapping/obstacle_layer.hpp>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace heel {
namespace {

bool positive(double x) { return x > 0.0 && std::isfinite(x); }

const RobotBody& checked(const RobotBody& body) {
  bool valid =
      std::isfinite(body.bottom_m) && std::isfinite(body.top_m) && body.top_m > body.bottom_m;
  if (const auto* round = std::get_if<RoundFootprint>(&body.footprint)) {
    valid = valid && positive(round->radius_m);
  } else {
    const auto& box = std::get<BoxFootprint>(body.footprint);
    valid = valid && positive(box.length_m) && positive(box.width_m) && std::isfinite(box.ahead_m);
  }
  if (!valid) throw std::invalid_argument("a robot's body must have a finite, positive size");
  return body;
}

void check(const FloorPose& pose) {
  if (!pose.position.allFinite() || !std::isfinite(pose.yaw_rad)) {
    throw std::invalid_argument("a body's pose must be finite");
  }
}

void checkMargin(double margin_m) {
  if (!(margin_m >= 0.0) || !std::isfinite(margin_m)) {
    throw std::invalid_argument("a body's margin must not be negative");
  }
}

bool overlap(const fcl::CollisionGeometryd& a, const fcl::Transform3d& T_a,
             const fcl::CollisionGeometryd& b, const fcl::Transform3d& T_b) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, T_a, &b, T_b, fcl::CollisionRequestd(), result) > 0;
}

/// The smaller of `up_to_m` and the distance of two shapes; 0 if they overlap.
double gap(const fcl::CollisionGeometryd& a, const fcl::Transform3d& T_a,
           const fcl::CollisionGeometryd& b, const fcl::Transform3d& T_b, double up_to_m) {
  fcl::DistanceRequestd request;  // a signed distance to an octree would abort the program
  // The default solver says too much for a box by an octree, which is the unsafe side.
  request.gjk_solver_type = fcl::GST_INDEP;
  const double limit_m = std::min(up_to_m, std::numeric_limits<double>::max());
  fcl::DistanceResultd result(limit_m);
  fcl::distance(&a, T_a, &b, T_b, request, result);
  if (result.min_distance >= limit_m) return up_to_m;
  return std::max(result.min_distance, 0.0);  // FCL says -1 of an overlap, which is no depth
}

/// Without nodes there is nothing to search, and FCL's distance() would follow a null pointer.
std::shared_ptr<const fcl::OcTreed> copied(const octomap::OcTree& walls) {
  if (walls.getRoot() == nullptr) return nullptr;
  const auto copy = std::make_shared<octomap::OcTree>(walls);
  // FCL skips inner nodes that are not occupied; after lazy insertions they are out of date.
  copy->updateInnerOccupancy();
  return std::make_shared<fcl::OcTreed>(copy);
}

}  // namespace

struct BodyCheck::Geometry {
  RobotBody body;
  std::shared_ptr<const fcl::OcTreed> walls;  // null without any
  double reach_m;                             // from the footprint's middle to its furthest point

  Geometry(const RobotBody& robot, const octomap::OcTree& tree)
      : body(checked(robot)), walls(copied(tree)), reach_m(radiusAround()) {}

  double radiusAround() const {
    if (const auto* round = std::get_if<RoundFootprint>(&body.footprint)) return round->radius_m;
    const auto& box = std::get<BoxFootprint>(body.footprint);
    return std::hypot(box.length_m, box.width_m) / 2.0;
  }
  double ahead_m() const {
    const auto* box = std::get_if<BoxFootprint>(&body.footprint);
    return box != nullptr ? box->ahead_m : 0.0;
  }
  double height_m() const { return body.top_m - body.bottom_m; }

  Eigen::Vector2d middle(const FloorPose& pose) const {
    return pose * Eigen::Vector2d(ahead_m(), 0.0);
  }
  /// Where FCL's shape is, whose origin is its middle.
  fcl::Transform3d placed(const FloorPose& pose) const {
    return basePose(pose) *
           Eigen::Translation3d(ahead_m(), 0.0, (body.bottom_m + body.top_m) / 2.0);
  }
  fcl::Transform3d placedColumn(const Eigen::Vector2d& at) const {
    return fcl::Transform3d(
        Eigen::Translation3d(at.x(), at.y(), (body.bottom_m + body.top_m) / 2.0));
  }
  fcl::Boxd column(const ObstacleLayer& layer) const {
    const double cell_m = layer.params().cell_size_m;
    return {cell_m, cell_m, height_m()};
  }

  /// Calls `use` with the body's shape, grown by a margin.
  template <typename Use>
  auto withShape(double margin_m, Use use) const {
    if (const auto* round = std::get_if<RoundFootprint>(&body.footprint)) {
      return use(fcl::Cylinderd(round->radius_m + margin_m, height_m()));
    }
    const auto& box = std::get<BoxFootprint>(body.footprint);
    return use(fcl::Boxd(box.length_m + 2.0 * margin_m, box.width_m + 2.0 * margin_m, height_m()));
  }

  bool hitsWall(const FloorPose& pose, double margin_m) const {
    if (!walls) return false;
    return withShape(margin_m, [&](const auto& shape) {
      return overlap(shape, placed(pose), *walls, fcl::Transform3d::Identity());
    });
  }

  bool hitsObstacle(const FloorPose& pose, const ObstacleLayer& layer, double margin_m) const {
    const Eigen::Vector2d at = middle(pose);
    const double diagonal_m = std::sqrt(2.0) * layer.params().cell_size_m;
    // A grown box's corners are further off than the margin.
    const double reach = reach_m + std::sqrt(2.0) * margin_m;
    const double nearest_m = layer.distance(at);
    if (std::isfinite(nearest_m) && nearest_m - diagonal_m > reach) return false;
    const double near_m = reach + diagonal_m / 2.0;
    const fcl::Boxd cell = column(layer);
    return withShape(margin_m, [&](const auto& shape) {
      const auto& all = layer.obstacles();
      return std::any_of(all.begin(), all.end(), [&](const Eigen::Vector2d& obstacle) {
        return (obstacle - at).squaredNorm() <= near_m * near_m &&
               overlap(shape, placed(pose), cell, placedColumn(obstacle));
      });
    });
  }

  double wallGap(const FloorPose& pose, double up_to_m) const {
    if (!walls) return up_to_m;
    return withShape(0.0, [&](const auto& shape) {
      return gap(shape, placed(pose), *walls, fcl::Transform3d::Identity(), up_to_m);
    });
  }

  double obstacleGap(const FloorPose& pose, const ObstacleLayer& layer, double up_to_m) const {
    const Eigen::Vector2d at = middle(pose);
    // No column is nearer than its middle is, less both shapes' reach.
    const double both_m = reach_m + layer.params().cell_size_m / std::sqrt(2.0);
    const fcl::Boxd cell = column(layer);
    return withShape(0.0, [&](const auto& shape) {
      double nearest_m = up_to_m;
      for (const Eigen::Vector2d& obstacle : layer.obstacles()) {
        const double within_m = nearest_m + both_m;
        if (nearest_m <= 0.0) break;
        if ((obstacle - at).squaredNorm() >= within_m * within_m) continue;
        nearest_m = gap(shape, placed(pose), cell, placedColumn(obstacle), nearest_m);
      }
      return nearest_m;
    });
  }
};

BodyCheck::BodyCheck(const RobotBody& body, const octomap::OcTree& walls)
    : geometry_(std::make_unique<const Geometry>(body, walls)) {}
BodyCheck::BodyCheck(BodyCheck&&) noexcept = default;
BodyCheck& BodyCheck::operator=(BodyCheck&&) noexcept = default;
BodyCheck::~BodyCheck() = default;

const RobotBody& BodyCheck::body() const { return geometry_->body; }

bool BodyCheck::collides(const FloorPose& T_world_base, double margin_m) const {
  check(T_world_base);
  checkMargin(margin_m);
  return geometry_->hitsWall(T_world_base, margin_m);
}

bool BodyCheck::collides(const FloorPose& T_world_base, const ObstacleLayer& layer,
                         double margin_m) const {
  return collides(T_world_base, margin_m) || geometry_->hitsObstacle(T_world_base, layer, margin_m);
}

double BodyCheck::clearance(const FloorPose& T_world_base, double up_to_m) const {
  check(T_world_base);
  if (!(up_to_m >= 0.0)) throw std::invalid_argument("a clearance's limit must not be negative");
  return geometry_->wallGap(T_world_base, up_to_m);
}

double BodyCheck::clearance(const FloorPose& T_world_base, const ObstacleLayer& layer,
                            double up_to_m) const {
  return geometry_->obstacleGap(T_world_base, layer, clearance(T_world_base, up_to_m));
}

std::optional<std::size_t> BodyCheck::firstCollision(const std::vector<FloorPose>& path,
                                                     const ObstacleLayer* layer, double margin_m,
                                                     double step_m) const {
  if (!(step_m > 0.0)) throw std::invalid_argument("a path's step must be positive");
  const auto hits = [&](const FloorPose& pose) {
    return layer != nullptr ? collides(pose, *layer, margin_m) : collides(pose, margin_m);
  };
  const double swing_m = std::abs(geometry_->ahead_m()) + geometry_->reach_m;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (hits(path[i])) return i;
    if (i + 1 == path.size()) break;
    check(path[i + 1]);
    const Eigen::Vector2d way = path[i + 1].position - path[i].position;
    const double turn = wrapped(path[i + 1].yaw_rad - path[i].yaw_rad);
    const double steps = std::ceil((way.norm() + std::abs(turn) * swing_m) / step_m);
    for (std::int64_t k = 1; static_cast<double>(k) < steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      if (hits({path[i].position + part * way, path[i].yaw_rad + part * turn})) return i + 1;
    }
  }
  return std::nullopt;
}

}  // namespace heel
