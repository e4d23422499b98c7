// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/scene_gate.hpp"

#include "apps/simulation/floor_plan.hpp"

#include <Eigen/Geometry>

namespace heel {
namespace {

constexpr double kBody_m = 0.15;            // Half of a thin person.
constexpr double kDisparityError_px = 0.5;  // Two standard deviations.

}  // namespace

GeometricGate mapGate(const Scene& scene, const StereoCamera& camera) {
  const FloorPlan plan(scene, true);
  const FloorBounds flat = floorBounds(scene);
  const Eigen::Vector2d start = scene.robot.start;
  const Eigen::Rotation2Dd turn(scene.robot.start_yaw_rad);
  const double focal_baseline = camera.left.fx * camera.baseline_m;
  return [=](const Observation& seen, const Viewpoint& viewpoint) {
    const Eigen::Vector2d place = start + turn * seen.position_m;
    if ((place.array() < flat.low.array()).any() || (place.array() > flat.high.array()).any()) {
      return GateVerdict::kOutOfBounds;
    }
    const double range2_m2 = (seen.position_m - viewpoint.position_m).squaredNorm();
    const double margin_m = kBody_m + kDisparityError_px * range2_m2 / focal_baseline;
    return plan.clearance(place) < margin_m ? GateVerdict::kInsideWall : GateVerdict::kAccepted;
  };
}

}  // namespace heel
