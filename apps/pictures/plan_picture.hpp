// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The plan view's half of an annotated picture.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/drawing.hpp>

namespace heel {

/// Draws the scene as seen from above into `panel`, the camera below, looking up.
/// @param ahead_m  How far the drawing reaches in front of the camera.
void drawPlan(const DrawnFrame& scene, double ahead_m, cv::Mat& panel);

/// The part of the floor within `range_m` of the camera that lies in its image; empty without a
/// camera. Its places are in the floor's frame.
std::vector<Eigen::Vector2d> visibleFloor(const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera, double range_m);

}  // namespace heel
