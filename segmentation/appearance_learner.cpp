// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_learner.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace heel {
AppearanceLearner::AppearanceLearner(const AppearanceParams& params)
    : params_(params), person_(params.bands.size()) {
  if (params.bands.empty()) throw std::invalid_argument("an appearance needs at least one band");
}

void AppearanceLearner::addRoom(const cv::Mat& image_bgr, const cv::Mat& mask) {
  if (image_bgr.type() != CV_8UC3) throw std::invalid_argument("the image must be CV_8UC3");
  if (!mask.empty() && (mask.type() != CV_8UC1 || mask.size() != image_bgr.size())) {
    throw std::invalid_argument("the mask must be CV_8UC1 and as large as the image");
  }
  for (int v = 0; v < image_bgr.rows; ++v) {
    const auto* pixels = image_bgr.ptr<cv::Vec3b>(v);
    const auto* wanted = mask.empty() ? nullptr : mask.ptr<std::uint8_t>(v);
    for (int u = 0; u < image_bgr.cols; ++u) {
      if (wanted == nullptr || wanted[u] != 0) room_.add(pixels[u][0], pixels[u][1], pixels[u][2]);
    }
  }
}

void AppearanceLearner::addPerson(const ColorCloud& cloud, const pcl::Indices& indices) {
  for (const auto index : indices) {
    const pcl::PointXYZRGB& p = cloud[static_cast<std::size_t>(index)];
    if (!std::isfinite(p.z)) continue;
    for (std::size_t band = 0; band < person_.size(); ++band) {
      if (params_.bands[band].contains(p.z)) person_[band].add(p.b, p.g, p.r);
    }
  }
}

void AppearanceLearner::addBody(const ColorCloud& cloud, const pcl::Indices& indices,
                                const Eigen::Vector2d& position_m) {
  describer_.describe(cloud, position_m, look_, &indices);
  portrait_.add(look_);
  if (look_.stature_m) heights_m_.push_back(*look_.stature_m);
}

}  // namespace heel
