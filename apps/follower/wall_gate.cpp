// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/wall_gate.hpp>

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// What the gate knows; shared by its copies.
class WallGate {
 public:
  WallGate(std::shared_ptr<const WallMap> map, const WallGateParams& params)
      : map_(std::move(map)), params_(params), walls_(map_->floorGrid(params.body)) {}

  GateVerdict judge(const Observation& seen, const Viewpoint& viewpoint) const {
    const Vector2d place = params_.observations_in_map * seen.position_m;
    const Vector2d eye = params_.observations_in_map * viewpoint.position_m;
    const Eigen::Matrix2d turn =
        Eigen::Rotation2Dd(params_.observations_in_map.yaw_rad).toRotationMatrix();
    const Eigen::Matrix2d covariance_m2 = turn * seen.covariance_m2 * turn.transpose();
    GateVerdict verdict = GateVerdict::kAccepted;
    for (const Vector2d& shift : shifts(viewpoint.covariance_m2)) {
      const Vector2d from = eye + shift;
      if (map_->isWall({from.x(), from.y(), params_.eye_height_m})) continue;
      const GateVerdict here = judge(from, place + shift, covariance_m2);
      if (here == GateVerdict::kAccepted) return here;
      if (verdict == GateVerdict::kAccepted) verdict = here;
    }
    return verdict;
  }

 private:
  /// None, and to both sides along both axes of the covariance, in the map's frame.
  std::array<Vector2d, 5> shifts(const Eigen::Matrix2d& covariance_m2) const {
    std::array<Vector2d, 5> result;
    result.fill(Vector2d::Zero());
    if (!(covariance_m2.trace() > 0.0)) return result;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(covariance_m2);
    const Eigen::Rotation2Dd turn(params_.observations_in_map.yaw_rad);
    for (int i = 0; i < 2; ++i) {
      const double reach_m = params_.sigmas * std::sqrt(std::max(axes.eigenvalues()[i], 0.0));
      const Vector2d shift = turn * Vector2d(reach_m * axes.eigenvectors().col(i));
      result[static_cast<std::size_t>(1 + 2 * i)] = shift;
      result[static_cast<std::size_t>(2 + 2 * i)] = -shift;
    }
    return result;
  }

  GateVerdict judge(const Vector2d& eye, const Vector2d& place,
                    const Eigen::Matrix2d& covariance_m2) const {
    const Vector2d way = place - eye;
    const double range_m = way.norm();
    const double variance_m2 =
        range_m > 0.0 ? way.dot(covariance_m2 * way) / (range_m * range_m) : 0.0;
    const double doubt_m = params_.half_body_m + params_.sigmas * std::sqrt(variance_m2);
    if (range_m > 1e-6) {
      const double longer = (range_m + doubt_m) / range_m;
      const Vector3d from(eye.x(), eye.y(), params_.eye_height_m);
      const Vector3d to_body(way.x(), way.y(), params_.body_height_m - params_.eye_height_m);
      const double hit_m =
          map_->firstWall(from, from + longer * to_body) * range_m / to_body.norm();
      if (hit_m < range_m - doubt_m) return GateVerdict::kBehindWall;
      if (std::isfinite(hit_m)) return GateVerdict::kInsideWall;
    }
    return walls_.isOccupiedWithin(place, params_.half_body_m) ? GateVerdict::kInsideWall
                                                               : GateVerdict::kAccepted;
  }

  std::shared_ptr<const WallMap> map_;
  WallGateParams params_;
  OccupancyGrid walls_;
};

}  // namespace

double depthErrorOf(const StereoCamera& camera, double disparity_error_px) {
  if (!(camera.left.fx > 0.0) || !(camera.baseline_m > 0.0)) return 0.0;
  return disparity_error_px / (camera.left.fx * camera.baseline_m);
}

GeometricGate wallGate(std::shared_ptr<const WallMap> map, const WallGateParams& params) {
  if (map == nullptr) throw std::invalid_argument("wallGate: there is no map");
  for (const double value : {params.half_body_m, params.sigmas, params.eye_height_m}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw std::invalid_argument("wallGate: a parameter must be finite and not negative");
    }
  }
  auto gate = std::make_shared<const WallGate>(std::move(map), params);
  return [gate](const Observation& seen, const Viewpoint& viewpoint) {
    return gate->judge(seen, viewpoint);
  };
}

}  // namespace heel
