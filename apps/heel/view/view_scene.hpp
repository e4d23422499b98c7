// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel view` shows, and the window that shows it.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/cloud/color_cloud.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <pcl/types.h>

#include <memory>
#include <string>

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

class SceneWindow {
 public:
  virtual ~SceneWindow() = default;

  /// Shows a scene instead of the last one, for so long; then returns. The view stays as the user
  /// has turned it.
  /// @return false once the user has closed the window.
  virtual bool show(const ViewScene& scene, double seconds) = 0;
};

/// Opens PCL's window. It lies in a library of its own, which is loaded here: nothing else of Heel
/// needs PCL's visualization, or waits for it to load.
/// @param why  Out: why there is none, in a few words.
/// @return Nothing without a display, or where Heel was built without the window.
std::unique_ptr<SceneWindow> openSceneWindow(std::string& why);

}  // namespace heel
