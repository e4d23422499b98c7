// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/obstacle_points.hpp>
#include <heel/apps/follower/param_checks.hpp>
#include <heel/apps/follower/wall_gate.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

// Whatever is so far behind a point is not a part of the same thing: a chair is as deep.
constexpr float kBehind_m = 0.5F;
// Of what gives no depth only so much is known: behind its near rim there may be more of a hole, or
// floor that something black hides.
constexpr float kRim_m = 0.15F;
constexpr float kSeen_m = std::numeric_limits<float>::infinity();

StereoCamera shrunk(const StereoCamera& camera, int width_px) {
  if (camera.left.width <= width_px) return camera;
  const double scale = static_cast<double>(width_px) / camera.left.width;
  StereoCamera small = camera;
  small.left.width = width_px;
  small.left.height = static_cast<int>(std::lround(camera.left.height * scale));
  small.left.fx *= scale;
  small.left.fy *= scale;
  // A pixel's middle is at its index, so the image's edge is half a pixel before 0.
  small.left.cx = (camera.left.cx + 0.5) * scale - 0.5;
  small.left.cy = (camera.left.cy + 0.5) * scale - 0.5;
  small.disparity_offset *= scale;
  return small;
}

StereoMatcherParams matching(const StereoCamera& camera, double nearest_m) {
  StereoMatcherParams params;
  const double most = camera.left.fx * camera.baseline_m / nearest_m - camera.disparity_offset;
  params.disparities = std::clamp(16 * static_cast<int>(std::ceil(most / 16.0)), 16, 256);
  params.speckle_size = 30;
  return params;
}

void check(const ObstaclePointsParams& p) {
  requireNotNegative("ObstaclePointsParams", {p.nearest_m, p.max_range_m});
  if (p.width_px < 1 || p.nearest_m == 0.0 || !(p.max_height_m > p.min_height_m)) {
    throw std::invalid_argument(
        "ObstaclePointsParams: need width_px >= 1, nearest_m > 0 and max_height_m > min_height_m");
  }
}

}  // namespace

ObstaclePoints::ObstaclePoints(const CameraSetup& setup, const ObstaclePointsParams& params)
    : sensor_((check(params), setup.sensor)),
      camera_(shrunk(setup.camera, params.width_px)),
      T_base_camera_(setup.T_base_camera.cast<float>()),
      deep_per_m_(sensor_ == SensorKind::kStereo
                      ? 2.0F * static_cast<float>(depthErrorOf(camera_)) *
                            T_base_camera_.translation().z()
                      : 0.0F),
      params_(params),
      matcher_(matching(camera_, params.nearest_m)) {}

const std::vector<Eigen::Vector3f>& ObstaclePoints::of(const Frame& frame) {
  const cv::Size size(camera_.left.width, camera_.left.height);
  switch (sensor_) {
    case SensorKind::kStereo:
      cv::resize(frame.image_bgr, left_, size, 0.0, 0.0, cv::INTER_AREA);
      cv::resize(frame.right_bgr, right_, size, 0.0, 0.0, cv::INTER_AREA);
      matcher_.match(left_, right_, disparity_);
      disparityToDepth(disparity_, camera_, depth_m_);
      findTexture();
      break;
    case SensorKind::kRgbd:
      cv::resize(frame.depth_m, depth_m_, size, 0.0, 0.0, cv::INTER_NEAREST);
      break;
    case SensorKind::kCloud:
      depthOf(*frame.cloud, left_);
      cv::resize(left_, depth_m_, size, 0.0, 0.0, cv::INTER_NEAREST);
      break;
  }
  collect();
  return points_;
}

bool ObstaclePoints::seesThrough(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f seen = T_base_camera_.inverse() * point;
  if (!(seen.z() > static_cast<float>(params_.nearest_m))) return false;
  const Eigen::Vector2d pixel = project(camera_.left, seen.cast<double>());
  const auto u = static_cast<int>(std::lround(pixel.x()));
  const auto v = static_cast<int>(std::lround(pixel.y()));
  if (u < 1 || v < 1 || u + 1 >= depth_m_.cols || v + 1 >= depth_m_.rows || isBlank(v, u)) {
    return false;
  }
  const bool is_step = !(point.z() > 0.0F);
  int through = 0;
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {  // Not where it is not a number.
      const float depth_m = depth_m_.at<float>(y, x);
      const bool is_through =
          is_step ? std::abs(heightAt(y, x)) < deepAt(depth_m) : depth_m > seen.z() + kBehind_m;
      through += is_through ? 1 : 0;
    }
  }
  return through >= (is_step ? 5 : 9);  // Floor has gaps in its depth.
}

// How far from the floor what is on it may seem: of an error in the depth d the height has eye / d.
float ObstaclePoints::deepAt(float depth_m) const {
  return std::max(static_cast<float>(params_.min_depth_m), deep_per_m_ * depth_m);
}

float ObstaclePoints::heightAt(int v, int u) const {
  const Eigen::Vector3f ray = rayOf(camera_.left, u, v).cast<float>();
  return (T_base_camera_ * Eigen::Vector3f(depth_m_.at<float>(v, u) * ray)).z();
}

bool ObstaclePoints::isBlank(int v, int u) const {
  return !texture_.empty() && texture_.at<std::uint8_t>(v, u) == 0;
}

void ObstaclePoints::findTexture() {
  cv::cvtColor(left_, grey_, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey_, slope_, CV_16S, 1, 0, 3, 0.25);  // a slope of one level a column is 8
  texture_ = cv::abs(slope_) >= 2 * params_.min_texture;
  cv::dilate(texture_, texture_, cv::Mat());
}

// Where a pixel shows floor, from below the camera; infinitely far at the horizon and above.
Eigen::Vector2f ObstaclePoints::floorAt(double v, double u) const {
  const Eigen::Vector3f ray = T_base_camera_.linear() * rayOf(camera_.left, u, v).cast<float>();
  if (!(ray.z() < 0.0F)) return Eigen::Vector2f::Constant(kSeen_m);
  return -T_base_camera_.translation().z() / ray.z() * ray.head<2>();
}

// Where it is seen through the floor, if that is near.
void ObstaclePoints::addStep(int v, int u, float within_m) {
  const Eigen::Vector2f eye = T_base_camera_.translation().head<2>();
  for (const double across : {-0.25, 0.25}) {
    for (const double down : {-0.25, 0.25}) {
      const Eigen::Vector2f away = floorAt(v + down, u + across);
      if (!(away.norm() < within_m)) continue;
      points_.emplace_back(eye.x() + away.x(), eye.y() + away.y(), 0.0F);
    }
  }
}

void ObstaclePoints::collect() {
  points_.clear();
  const PinholeCamera& camera = camera_.left;
  const Eigen::Vector3f eye = T_base_camera_.translation();
  const auto nearest = static_cast<float>(params_.nearest_m);
  const auto low = static_cast<float>(params_.min_height_m);
  const auto high = static_cast<float>(params_.max_height_m);
  const auto range = static_cast<float>(params_.max_range_m);
  unseen_from_m_.assign(static_cast<std::size_t>(depth_m_.cols), kSeen_m);
  for (int v = depth_m_.rows - 1; v >= 0; --v) {  // the nearest floor first
    const float* depth = depth_m_.ptr<float>(v);
    for (int u = 0; u < depth_m_.cols; ++u) {
      float& unseen_from_m = unseen_from_m_[static_cast<std::size_t>(u)];
      if (!(depth[u] > nearest && std::isfinite(depth[u]))) {  // NaN too
        if (!params_.needs_floor) continue;
        const float floor_m = floorAt(v, u).norm();
        unseen_from_m = std::min(unseen_from_m, floor_m);
        if (floor_m < unseen_from_m + kRim_m) addStep(v, u, range);
        continue;
      }
      unseen_from_m = kSeen_m;
      if (isBlank(v, u)) continue;
      const Eigen::Vector3f seen = rayOf(camera, u, v).cast<float>() * depth[u];
      const Eigen::Vector3f point = T_base_camera_ * seen;
      if (point.z() < -deepAt(depth[u])) {
        addStep(v, u, std::numeric_limits<float>::infinity());
        continue;
      }
      if (point.z() < low || point.z() > high) continue;
      if ((point - eye).head<2>().norm() > range) continue;
      points_.push_back(point);
    }
  }
}

}  // namespace heel
