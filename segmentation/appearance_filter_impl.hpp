// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The bodies of AppearanceFilter, for the point types that it is not instantiated for.
#pragma once

#include <heel/segmentation/appearance_filter.hpp>

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>

#include <cstddef>

namespace heel {

template <typename PointT>
AppearanceFilter<PointT>::AppearanceFilter(bool extract_removed_indices)
    : Base(extract_removed_indices) {
  filter_name_ = "AppearanceFilter";
}

template <typename PointT>
void AppearanceFilter<PointT>::applyFilter(pcl::Indices& indices) {
  if (table_.empty()) {
    PCL_ERROR("[heel::%s::applyFilter] No colour table given!\n", this->getClassName().c_str());
    removed_indices_->clear();
    indices.clear();
    return;
  }

  // The lists are built aside, for `indices` may be *indices_ itself.
  const std::size_t n = indices_->size();
  if (kept_.size() < n) kept_.resize(n);
  if (extract_removed_indices_ && removed_.size() < n) removed_.resize(n);
  const std::size_t n_kept = extract_removed_indices_ ? select<true>() : select<false>();
  const std::size_t n_removed = extract_removed_indices_ ? n - n_kept : 0;
  removed_indices_->assign(removed_.data(), removed_.data() + n_removed);
  indices.assign(kept_.data(), kept_.data() + n_kept);
}

template <typename PointT>
template <bool kListRemoved>
std::size_t AppearanceFilter<PointT>::select() {
  // Every index is written to the end of its list, and the end moves on if it belongs there: a
  // branch would depend on a noisy image, and take twice the time.
  const pcl::Indices& visited = *indices_;
  const PointCloud& cloud = *input_;
  pcl::index_t* kept = kept_.data();
  pcl::index_t* removed = removed_.data();
  const std::uint8_t* scores = table_.data();
  const std::uint8_t threshold = table_.threshold();
  const bool wanted = !negative_;
  std::size_t n_kept = 0;
  for (std::size_t n = 0; n < visited.size(); ++n) {
    const pcl::index_t i = visited[n];
    const PointT& p = cloud[i];
    const bool passes = scores[ColorTable::cell(p.b, p.g, p.r)] > threshold;
    kept[n_kept] = i;
    if constexpr (kListRemoved) removed[n - n_kept] = i;
    n_kept += static_cast<unsigned>(passes == wanted) & static_cast<unsigned>(pcl::isFinite(p));
  }
  return n_kept;
}

}  // namespace heel

// The name is only pasted by PCL_INSTANTIATE, so a foreign namespace is fine.
#define PCL_INSTANTIATE_AppearanceFilter(T) template class PCL_EXPORTS heel::AppearanceFilter<T>;
