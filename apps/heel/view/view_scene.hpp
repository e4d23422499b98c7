// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One moment of a recording in three dimensions.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/cloud/color_cloud.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <pcl/types.h>

namespace heel {

/// What is to be seen. Places are in a frame with Z up whose z = 0 is the floor.
struct ViewScene {
  ColorCloud::ConstPtr cloud;
  pcl::Indices marked;  ///< Its points that have the target's colours.
  DrawnFrame drawn;     ///< Camera, blobs, tracks, state; its images are not used.
  OccupancyGrid walls;  ///< May be empty.
};

/// From where one looks.
struct ViewPoint {
  Eigen::Vector3d eye_m;
  Eigen::Vector3d target_m;
};

/// Over the shoulder of the recording's camera.
ViewPoint behindCamera(const Eigen::Isometry3d& T_floor_camera);

/// The scene's points with their colours, the marked ones tinted; those without a place are black.
ColorCloud::Ptr tintedCloud(const ViewScene& scene);

/// The walls as low columns of points.
ColorCloud::Ptr wallPoints(const OccupancyGrid& walls);

}  // namespace heel
