// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/height_crop.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {

HeightCrop::HeightCrop(const HeightCropParams& params) {
  if (!std::isfinite(params.min_m) || !std::isfinite(params.max_m) ||
      params.min_m >= params.max_m) {
    throw std::invalid_argument("height crop: min_m must be below max_m, both finite");
  }
  pass_.setFilterFieldName("z");
  pass_.setFilterLimits(static_cast<float>(params.min_m), static_cast<float>(params.max_m));
}

void HeightCrop::apply(const ColorCloud::ConstPtr& cloud, const pcl::IndicesPtr& indices,
                       pcl::Indices& kept) {
  if (cloud == nullptr || cloud->empty()) {  // PCL would look for the field in no point
    kept.clear();
    return;
  }
  pass_.setInputCloud(cloud);
  pass_.setIndices(indices);
  pass_.filter(kept);
}

}  // namespace heel
