// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/planview/cloud_plan.hpp>
#include <heel/apps/recording/camera_file.hpp>
#include <heel/cloud/color_cloud.hpp>
#include <heel/segmentation/appearance_filter.hpp>

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

namespace {

/// Of a person, where the surface that a point stands for is not known.
constexpr double kLeastFootprint_m2 = 0.06;

/// Finds T_base_optical, and says where from.
void placeOnFloor(const std::filesystem::path& file, const ColorCloud& optical,
                  const CloudPlanParams& params, CloudPlan& plan) {
  if (params.mounting) {
    plan.floor = FloorSource::kGiven;
    plan.T_base_cloud = baseFromCamera(*params.mounting);
  } else {
    const auto camera_file = file.parent_path() / "camera.yaml";
    std::optional<Eigen::Isometry3d> configured;
    if (std::filesystem::exists(camera_file)) {
      configured = readCameraFile(camera_file).T_ground_camera;
    }
    if (configured) {
      plan.floor = FloorSource::kCameraFile;
      plan.T_base_cloud = *configured;
    } else {
      GroundPlaneEstimator estimator(params.ground);
      estimator.add(optical);
      const auto ground = estimator.estimate();
      if (!ground) {
        throw std::runtime_error(file.string() +
                                 ": no floor is seen in the cloud, and nothing says how high its "
                                 "origin is (--height, --up)");
      }
      plan.floor = FloorSource::kCloud;
      plan.T_base_cloud = ground->T_base_camera;
    }
  }
  plan.mounting = mountingOf(plan.T_base_cloud);
}

/// The points at a person's heights; each band of the model keeps its own colours.
pcl::Indices standingPoints(const ColorCloud::ConstPtr& cloud, const AppearanceModel* model,
                            const HeightCropParams& heights, CloudPlan& plan) {
  pcl::Indices standing;
  if (model == nullptr) {
    HeightCrop(heights).apply(cloud, nullptr, standing);
    return standing;
  }
  AppearanceFilter<pcl::PointXYZRGB> filter;
  const pcl::IndicesPtr candidates(new pcl::Indices), in_band(new pcl::Indices);
  filter.setInputCloud(cloud);
  filter.setTable(model->filterTable());
  filter.filter(*candidates);
  plan.color_points = candidates->size();
  for (const AppearanceBand& band : model->bands()) {
    if (band.table.empty()) continue;
    HeightCrop({band.body.min_height_m, band.body.max_height_m}).apply(cloud, candidates, *in_band);
    filter.setTable(band.table);
    filter.setIndices(in_band);
    filter.filter(*in_band);
    standing.insert(standing.end(), in_band->begin(), in_band->end());
  }
  return standing;
}

}  // namespace

Eigen::Matrix3d opticalFromUp(const std::string& up) {
  const auto axis = [](const std::string& name) {
    Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();
    const double sign = name.front() == '-' ? -1.0 : 1.0;
    const auto index = std::string("xyz").find(name.back());
    if (index == std::string::npos || name.size() > (sign < 0.0 ? 2U : 1U)) return direction;
    direction[static_cast<Eigen::Index>(index)] = sign;
    return direction;
  };
  const Eigen::RowVector3d up_axis = up.empty() ? Eigen::RowVector3d::Zero() : axis(up);
  if (up_axis.isZero()) {
    throw std::invalid_argument("'" + up + "' is no axis; there are x, y, z, -x, -y, -z");
  }
  const std::string forward = up.back() == 'z' ? "x" : up == "y" ? "-z" : "z";
  Eigen::Matrix3d R;
  R.row(2) = axis(forward);
  R.row(1) = -up_axis;
  R.row(0) = R.row(1).cross(R.row(2));
  return R;
}

const char* toText(FloorSource source) {
  switch (source) {
    case FloorSource::kGiven:
      return "given";
    case FloorSource::kCameraFile:
      return "camera.yaml";
    case FloorSource::kCloud:
      return "cloud";
  }
  return "unknown";
}

std::size_t CloudPlan::people() const {
  return static_cast<std::size_t>(std::count(is_person.begin(), is_person.end(), true));
}

CloudPlan planCloud(const std::filesystem::path& file, const CloudFile& cloud,
                    const AppearanceModel* model, const CloudPlanParams& params) {
  if (model != nullptr) needColors(file, cloud.facts);
  CloudPlan plan;
  Eigen::Isometry3d T_optical_cloud = Eigen::Isometry3d::Identity();
  T_optical_cloud.linear() = params.R_optical_cloud;
  const auto placed = pcl::make_shared<ColorCloud>();
  pcl::transformPointCloud(cloud.cloud, *placed, T_optical_cloud.matrix().cast<float>());
  const auto camera = fitPinhole(*placed);
  placeOnFloor(file, *placed, params, plan);
  pcl::transformPointCloud(*placed, *placed, plan.T_base_cloud.matrix().cast<float>());
  const Eigen::Vector3d origin_m = plan.T_base_cloud.translation();
  plan.T_base_cloud = plan.T_base_cloud * T_optical_cloud;

  plan.color_points = cloud.facts.finite_points;
  const pcl::Indices standing = standingPoints(placed, model, params.heights, plan);
  plan.standing_points = standing.size();
  PlanViewCamera eye{origin_m, PlanViewCamera().focal_length_px};
  WorldBlobParams blob_params = params.blobs;
  plan.has_camera = camera.has_value();
  if (camera) {
    eye.focal_length_px = camera->fx;
    plan.heading_rad = std::atan2(camera->width / 2.0, camera->fx);
  } else {
    blob_params.min_area_m2 = 0.0;  // what a point stands for is not known
  }
  plan.view.emplace(params.plan_view, eye);
  const ColorTable colors = model == nullptr ? ColorTable() : model->filterTable();
  plan.view->build(*placed, standing, model == nullptr ? nullptr : &colors);
  WorldBlobFinder finder(blob_params);
  finder.find(*plan.view, plan.blobs);
  PersonShape shape = model == nullptr ? PersonShape::inUnknownScene() : PersonShape();
  if (!plan.has_camera) shape.min_area_m2 = 0.0;
  const double cell_m2 = plan.view->cellSize() * plan.view->cellSize();
  plan.is_person.resize(plan.blobs.size());
  std::transform(
      plan.blobs.begin(), plan.blobs.end(), plan.is_person.begin(), [&](const WorldBlob& blob) {
        const bool is_large = plan.has_camera || blob.cells * cell_m2 >= kLeastFootprint_m2;
        return is_large && hasPersonShape(blob, shape);
      });
  for (const int cell : plan.view->occupied()) plan.blob_of_cell.push_back(finder.blobOf(cell));
  return plan;
}

}  // namespace heel
