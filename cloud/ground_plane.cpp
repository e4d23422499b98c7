// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/ground_plane.hpp>

#include <pcl/common/centroid.h>
#include <pcl/memory.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_perpendicular_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// Optical axes (columns) in the axes of a camera that looks along X: forward, left, up.
Eigen::Matrix3d opticalAxes() {
  return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
}

}  // namespace

Eigen::Isometry3d baseFromCamera(const Mounting& mounting) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = mounting.height_m;
  T.linear() = Eigen::AngleAxisd(mounting.pitch_rad, Eigen::Vector3d::UnitY()) *
               Eigen::AngleAxisd(mounting.roll_rad, Eigen::Vector3d::UnitX()).toRotationMatrix() *
               opticalAxes();
  return T;
}

Mounting mountingOf(const Eigen::Isometry3d& T_base_camera) {
  // The base's Z in the camera's forward-left-up axes: (-sin pitch, cos pitch sin roll, cos pitch
  // cos roll).
  const Eigen::RowVector3d up = T_base_camera.linear().row(2) * opticalAxes().transpose();
  return {T_base_camera.translation().z(), std::asin(std::clamp(-up.x(), -1.0, 1.0)),
          std::atan2(up.y(), up.z())};
}

namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;
using PlaneModel = pcl::SampleConsensusModelPerpendicularPlane<pcl::PointXYZ>;

constexpr std::size_t kFewestPoints = 100;

// Most points below a floor, per point of it. Below a floor there is only noise; below a table
// there is the floor.
constexpr double kMaxBelowShare = 0.15;
constexpr double kBelow_m = 0.1;  // What is lower than this is below the floor; further down ...
constexpr double kBelowPerSquare_m = 0.02;  // ... by this per squared metre of depth, as the noise.
constexpr std::size_t kPointsPerFrame = 4000;  // So many points are drawn evenly from each cloud.
constexpr int kMaxPlanes = 6;                  // floor, table tops, seats

/// (n, d) with n towards the camera, so that the camera is above.
Eigen::Vector4d upwards(const Eigen::VectorXf& coefficients) {
  const Eigen::Vector4d plane = coefficients.head<4>().cast<double>();
  return plane.w() < 0.0 ? Eigen::Vector4d(-plane) : plane;
}

double heightOver(const Eigen::Vector4d& plane, const pcl::PointXYZ& p) {
  return plane.head<3>().dot(p.getVector3fMap().cast<double>()) + plane.w();
}

std::size_t countBelow(const Points& points, const Eigen::Vector4d& plane) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const pcl::PointXYZ& p) {
        const double depth = p.z;
        return heightOver(plane, p) < -(kBelow_m + kBelowPerSquare_m * depth * depth);
      }));
}

/// A plane, moved to where the points about it are, and those points.
struct FittedPlane {
  Eigen::Vector4d plane = Eigen::Vector4d::Zero();
  pcl::Indices inliers;
};

FittedPlane fit(PlaneModel& model, double distance_m, Eigen::VectorXf coefficients) {
  FittedPlane fitted;
  model.selectWithinDistance(coefficients, distance_m, fitted.inliers);
  for (int i = 0; i < 3 && fitted.inliers.size() >= kFewestPoints; ++i) {
    Eigen::VectorXf refined;
    model.optimizeModelCoefficients(fitted.inliers, coefficients, refined);
    coefficients = refined;
    model.selectWithinDistance(coefficients, distance_m, fitted.inliers);
  }
  fitted.plane = upwards(coefficients);
  return fitted;
}

Mounting mountingOver(const Eigen::Vector4d& plane) {
  const Eigen::Vector3d up = plane.head<3>();
  return {plane.w(), std::asin(std::clamp(-up.z(), -1.0, 1.0)), std::atan2(-up.x(), -up.y())};
}

}  // namespace

GroundPlaneEstimator::GroundPlaneEstimator(const GroundPlaneParams& params,
                                           const Eigen::Vector3d& up_in_camera)
    : params_(params), up_(up_in_camera.normalized()), points_(pcl::make_shared<Points>()) {
  const bool positive = params.max_range_m > 0.0 && params.inlier_distance_m > 0.0 &&
                        params.max_tilt_rad > 0.0 && params.min_inlier_share > 0.0 &&
                        params.max_points > 0;
  if (!positive) throw std::invalid_argument("GroundPlaneEstimator: a parameter is not positive");
  if (!(up_in_camera.norm() > 0.0)) {
    throw std::invalid_argument("GroundPlaneEstimator: up has no direction");
  }
}

void GroundPlaneEstimator::add(const ColorCloud& cloud) {
  const auto usable = [&](const pcl::PointXYZRGB& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) &&
           p.getVector3fMap().norm() <= params_.max_range_m;
  };
  const auto count = static_cast<std::size_t>(std::count_if(cloud.begin(), cloud.end(), usable));
  if (count == 0) return;
  const std::size_t step = (count + kPointsPerFrame - 1) / kPointsPerFrame;
  std::size_t seen = 0;
  for (const auto& p : cloud) {
    if (isFull()) return;
    if (usable(p) && seen++ % step == 0) points_->push_back({p.x, p.y, p.z});
  }
}

std::optional<GroundPlane> GroundPlaneEstimator::estimate(
    const std::optional<Eigen::Vector4d>& expected) const {
  if (points_->size() < kFewestPoints) return std::nullopt;
  const auto needed = std::max(
      kFewestPoints, static_cast<std::size_t>(std::ceil(params_.min_inlier_share *
                                                        static_cast<double>(points_->size()))));
  pcl::Indices remaining(points_->size());
  std::iota(remaining.begin(), remaining.end(), 0);
  const auto modelOf = [&](const pcl::Indices& of) {
    const auto model = pcl::make_shared<PlaneModel>(points_, of);
    model->setAxis(up_.cast<float>());
    model->setEpsAngle(params_.max_tilt_rad);
    return model;
  };
  const auto isFloor = [&](const FittedPlane& fitted) {
    const auto below = static_cast<double>(countBelow(*points_, fitted.plane));
    return fitted.inliers.size() >= needed &&
           fitted.plane.head<3>().dot(up_) > std::cos(params_.max_tilt_rad) &&
           below <= kMaxBelowShare * static_cast<double>(fitted.inliers.size());
  };
  FittedPlane floor;
  if (expected) {
    FittedPlane fitted =
        fit(*modelOf(remaining), params_.inlier_distance_m, expected->cast<float>());
    if (isFloor(fitted)) floor = std::move(fitted);
  }
  // RANSAC gives the planes from the largest down: the first with nothing below it is the floor.
  for (int k = 0; k < kMaxPlanes && remaining.size() >= needed; ++k) {
    const auto model = modelOf(remaining);
    pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, params_.inlier_distance_m);
    ransac.setMaxIterations(1000);
    if (!ransac.computeModel()) break;
    Eigen::VectorXf drawn;
    ransac.getModelCoefficients(drawn);
    FittedPlane fitted = fit(*model, params_.inlier_distance_m, drawn);
    if (fitted.inliers.size() < std::max(needed, floor.inliers.size())) break;
    if (isFloor(fitted)) {
      floor = std::move(fitted);
      break;
    }
    pcl::Indices others;
    std::sort(fitted.inliers.begin(), fitted.inliers.end());
    std::set_difference(remaining.begin(), remaining.end(), fitted.inliers.begin(),
                        fitted.inliers.end(), std::back_inserter(others));
    remaining.swap(others);
  }
  if (floor.inliers.empty()) return std::nullopt;
  GroundPlane found;
  found.plane = floor.plane;
  found.mounting = mountingOver(floor.plane);
  found.T_base_camera = baseFromCamera(found.mounting);
  found.points = points_->size();
  found.inlier_share =
      static_cast<double>(floor.inliers.size()) / static_cast<double>(points_->size());
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  pcl::computeMeanAndCovarianceMatrix(*points_, floor.inliers, found.covariance_m2, mean);
  found.mean_m = mean.head<3>();
  return found;
}

double GroundPlane::rmsHeight(const Eigen::Vector4d& over) const {
  const Eigen::Vector3d normal = over.head<3>();
  const double mean = normal.dot(mean_m) + over.w();
  return std::sqrt(std::max(normal.dot(covariance_m2 * normal), 0.0) + mean * mean);
}

std::string mountingWarning(const GroundPlane& floor, const Eigen::Isometry3d& T_base_camera,
                            double tolerance_m) {
  const double apart_m = floor.rmsHeight(T_base_camera.matrix().row(2));
  if (apart_m <= tolerance_m) return {};
  constexpr double kDegrees = 180.0 / M_PI;
  const Mounting found = floor.mounting, configured = mountingOf(T_base_camera);
  std::array<char, 320> text{};
  std::snprintf(
      text.data(), text.size(),
      "Where the floor is seen it is %.2f m off: by it the camera is %.2f m high, pitched "
      "%.1f deg and rolled %.1f deg, but %.2f m, %.1f deg and %.1f deg are configured: "
      "correct the mounting%s.",
      apart_m, found.height_m, found.pitch_rad * kDegrees, found.roll_rad * kDegrees,
      configured.height_m, configured.pitch_rad * kDegrees, configured.roll_rad * kDegrees,
      found.height_m < configured.height_m ? ", unless this is a table's top" : "");
  return text.data();
}

}  // namespace heel
