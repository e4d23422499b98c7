// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A person's body as tapered capsules, posed by a gait.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <Eigen/Geometry>

#include <vector>

namespace heel {

/// What covers a part of the body.
enum class BodyCover { kTop, kTrousers, kShoes, kSkin, kHair };

/// A sphere that goes from `a` to `b` while its radius changes: one part of a body.
struct BodyPart {
  Eigen::Vector3f a;
  Eigen::Vector3f b;
  float radius_a = 0.0F;
  float radius_b = 0.0F;
  BodyCover cover = BodyCover::kSkin;
  int person = 0;  ///< Index in the scene.
  /// World to cloth: X to the part's front, Z along it, in metres; patterns are drawn in it.
  Eigen::Isometry3f cloth_from_world = Eigen::Isometry3f::Identity();
};

/// Where a person is and how far their legs have got.
struct BodyPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< Under the hips, world frame [m].
  double yaw_rad = 0.0;
  double gait_rad = 0.0;   ///< Phase: 2 pi is two steps.
  double speed_mps = 0.0;  ///< Sets how far the limbs swing.
  double time_s = 0.0;     ///< For the slow sway of someone who stands.
};

/// Length of two steps at a speed [m]; a walker's phase advances by 2 pi each.
double strideLength(const ScenePerson& person, double speed_mps);

/// Adds the parts of `person` (number `index` of the scene) to `parts`. Feet touch the floor and
/// the top of the hair is at the person's height when they stand.
void appendBody(const ScenePerson& person, int index, const BodyPose& pose,
                std::vector<BodyPart>& parts);

}  // namespace heel
