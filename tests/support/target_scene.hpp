// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A rendered stereo pair of a person to follow, with all that the perception step needs.
#pragma once

#include "tests/support/stereo_scene.hpp"
#include <heel/cloud/pinhole_camera.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <Eigen/Geometry>

namespace heel::test {

/// A room with a person in red, seen as 640x480 by a camera at a person's waist.
///
/// About a tenth of the pixels have the target's colours: the person; things of the same red, near
/// and far; and lone specks.
struct TargetScene {
  StereoScene pair;
  cv::Mat1f depth_m;  ///< Exact, of the left image.
  cv::Mat1b person;   ///< 255 where the left image shows them.
  StereoCamera camera{{640, 480, 500.0, 500.0, 319.5, 239.5}, 0.15, 0.0};
  Eigen::Isometry3d T_base_camera;
  Eigen::Vector2d place_m;  ///< Of the torso, in the base frame.
};

TargetScene targetScene();

/// The person's colours in the scene against everything that is not of their red.
AppearanceModel modelOf(const TargetScene& scene, const AppearanceParams& params = {});

}  // namespace heel::test
