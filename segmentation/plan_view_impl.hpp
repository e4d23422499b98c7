// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The body of PlanView::build, for the point types that it is not instantiated for.
#pragma once

#include <heel/segmentation/plan_view.hpp>

#include <algorithm>
#include <cstddef>

namespace heel {

template <typename PointT>
void PlanView::build(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices,
                     const ColorTable* colors) {
  constexpr float kHighest_m = 1000.0F;  // leaves out what is not finite
  for (const int cell : occupied_) cells_[static_cast<std::size_t>(cell)] = PlanCell{};
  occupied_.clear();
  points_ = 0;
  for (const pcl::index_t i : indices) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    const int at = cellAt(p.x, p.y);
    if (at < 0 || !(p.z >= 0.0F && p.z <= kHighest_m)) continue;
    PlanCell& cell = cells_[static_cast<std::size_t>(at)];
    if (cell.points++ == 0) occupied_.push_back(at);
    cell.max_height_m = std::max(cell.max_height_m, p.z);
    const float dx = p.x - camera_m_.x();
    const float dy = p.y - camera_m_.y();
    const float dz = p.z - camera_m_.z();
    cell.area_m2 += (dx * dx + dy * dy + dz * dz) * area_per_square_m_;
    if (colors != nullptr) {
      cell.appearance += static_cast<float>((*colors)(p.b, p.g, p.r)) * (1.0F / 255.0F);
    }
    ++points_;
  }
}

}  // namespace heel

// The name is only pasted by PCL_INSTANTIATE.
#define PCL_INSTANTIATE_PlanView(T)                                                   \
  template void heel::PlanView::build(const pcl::PointCloud<T>&, const pcl::Indices&, \
                                      const heel::ColorTable*);
