// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Pictures of the world as an ideal camera would get them, with the truth about every pixel.
#pragma once

#include <heel/apps/simulation/shader.hpp>
#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

namespace heel {

/// One view; its memory is reused from one rendering to the next.
struct RenderedView {
  cv::Mat radiance;  ///< CV_32FC3, blue, green, red.
  cv::Mat depth_m;   ///< CV_32FC1, along the optical axis, through the pixel's centre; NaN = none.
  cv::Mat people;    ///< CV_8UC1: 0, or 1 + the number of the person that the pixel's centre shows.
  cv::Mat surface;   ///< CV_32SC1: which surface; it changes where edges must be smoothed.
};

/// Renders `view` of the world's present state. Rows are shared among the threads of the caller's
/// TBB arena; the result does not depend on their number.
///
/// @param T_world_camera  Maps the optical frame to the world.
void renderView(const RayWorld& world, const Shader& shader, const PinholeCamera& camera,
                const Eigen::Isometry3d& T_world_camera, RenderedView& view);

}  // namespace heel
