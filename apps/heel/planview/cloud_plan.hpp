// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One cloud, whatever its frame, from above.
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/cloud/ground_plane.hpp>
#include <heel/segmentation/appearance_model.hpp>
#include <heel/segmentation/height_crop.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Turns a cloud's axes into those of a camera's optical frame (Z forward, X right, Y down), of
/// which only "up" is known: "-y" is such a frame already, "z" has X forward (ROS, laser scans),
/// "y" looks along -Z (computer graphics).
/// @throws std::invalid_argument  if `up` is none of x, y, z, -x, -y, -z.
Eigen::Matrix3d opticalFromUp(const std::string& up);

struct CloudPlanParams {
  Eigen::Matrix3d R_optical_cloud = Eigen::Matrix3d::Identity();  ///< See opticalFromUp().
  /// Where the cloud's origin is; else from camera.yaml beside the cloud; else from its floor.
  std::optional<Mounting> mounting;
  GroundPlaneParams ground;
  HeightCropParams heights;  ///< Of points that count, where no model says.
  PlanViewParams plan_view;
  WorldBlobParams blobs;
};

/// Where the floor was taken from.
enum class FloorSource { kGiven, kCameraFile, kCloud };
const char* toText(FloorSource source);

/// A cloud from above. The base frame is on the floor under the cloud's origin: X forward, Z up.
struct CloudPlan {
  FloorSource floor = FloorSource::kGiven;
  Mounting mounting;
  Eigen::Isometry3d T_base_cloud = Eigen::Isometry3d::Identity();
  bool has_camera = false;   ///< The cloud comes from one pinhole camera: only then is area known.
  double heading_rad = 0.0;  ///< Half of the angle that it sees, to either side; 0: not known.
  std::size_t color_points = 0;     ///< Points of the model's colours; all, without a model.
  std::size_t standing_points = 0;  ///< Of them, those at the right heights.
  std::optional<PlanView> view;
  std::vector<WorldBlob> blobs;  ///< Highest score first.
  std::vector<bool> is_person;  ///< Per blob: hasPersonShape(); without a camera, by its footprint.
  std::vector<int> blob_of_cell;  ///< Per occupied cell of the view; -1: of none.
  std::size_t people() const;     ///< How many blobs have a person's shape.
};

/// Finds the floor, keeps the points at a person's heights (and, with a model, of each height's
/// colours), and looks at them from above (sections 3.1 and 3.2).
/// @param model  May be null: all points count, and a person must be half seen.
/// @throws std::runtime_error  with a sentence that names the file, if no floor is found, or the
///         model needs colours and there are none.
CloudPlan planCloud(const std::filesystem::path& file, const CloudFile& cloud,
                    const AppearanceModel* model, const CloudPlanParams& params);

/// The occupied cells, brighter where they are higher and tinted where they belong to a blob; the
/// blobs with their numbers and heights, those of a person's shape with a thick ring; the cloud's
/// origin as a wedge. X goes up, y to the left; a grid of metres. CV_8UC3, 720 x 640 or so.
/// @param title  Over the picture; cut where it has no room.
cv::Mat drawPlanView(const CloudPlan& plan, const std::string& title);

}  // namespace heel
