// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud/color_cloud.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {

void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const PinholeCamera& camera,
                    const Eigen::Isometry3d& T_base_camera, ColorCloud& cloud) {
  pcl::Indices indices;
  makeColorCloud(depth_m, image_bgr, cv::Mat(), camera, T_base_camera, cloud, indices);
}

void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
                    const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                    ColorCloud& cloud, pcl::Indices& indices) {
  if (depth_m.type() != CV_32FC1 || image_bgr.type() != CV_8UC3 ||
      depth_m.size() != image_bgr.size()) {
    throw std::invalid_argument("makeColorCloud: depth and colour images do not fit");
  }
  const auto width = static_cast<std::uint32_t>(depth_m.cols);
  const auto height = static_cast<std::uint32_t>(depth_m.rows);
  cloud.resize(std::size_t{width} * height);
  cloud.width = width;
  cloud.height = height;
  cloud.is_dense = false;
  indices.clear();
  const Eigen::Isometry3f T = T_base_camera.cast<float>();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  const float inv_fx = static_cast<float>(1.0 / camera.fx);
  const float inv_fy = static_cast<float>(1.0 / camera.fy);
  for (int v = 0; v < depth_m.rows; ++v) {
    const float* depth = depth_m.ptr<float>(v);
    const auto* bgr = image_bgr.ptr<cv::Vec3b>(v);
    const std::uint8_t* wanted = mask.empty() ? nullptr : mask.ptr<std::uint8_t>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      auto& p = cloud[static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u)];
      p.b = bgr[u][0];
      p.g = bgr[u][1];
      p.r = bgr[u][2];
      p.a = 255;
      if ((wanted != nullptr && wanted[u] == 0) || !(depth[u] > 0.0F)) {
        p.x = p.y = p.z = nan;
        continue;
      }
      const float z = depth[u];
      const Eigen::Vector3f in_camera((static_cast<float>(u) - cx) * inv_fx * z,
                                      (static_cast<float>(v) - cy) * inv_fy * z, z);
      p.getVector3fMap() = T * in_camera;
      indices.push_back(v * depth_m.cols + u);
    }
  }
}

}  // namespace heel
