// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The image's half of an annotated picture.
#pragma once

#include <heel/apps/pictures/annotate.hpp>

namespace heel {

/// Draws the scene's image, fitted into `panel`: what the mask lets pass is tinted, the rest
/// dimmed, and blobs and tracks are marked where they stand.
void drawImage(const DrawnFrame& scene, cv::Mat& panel);

/// Projects a point of the floor's frame into the image [px]; absent behind the camera.
std::optional<cv::Point2d> projectToImage(const Eigen::Vector3d& point_m,
                                          const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera);

}  // namespace heel
