// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The bodies of AppearanceFilter, for the point types that it is not instantiated for.
#pragma once

#include "segmentation/appearance_filter.hpp"

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

  // The lists are built aside, for `indices` may be *indices_ itself. Every index is written to the
  // end of the list, and the end moves on if it is kept: a branch would depend on a noisy image,
  // and take twice the time.
  const pcl::Indices& visited = *indices_;
  const PointCloud& cloud = *input_;
  if (kept_.size() < visited.size()) kept_.resize(visited.size());
  pcl::index_t* kept = kept_.data();
  std::size_t n_kept = 0;
  const std::uint8_t* scores = table_.data();
  const std::uint8_t threshold = table_.threshold();
  const bool wanted = !negative_;
  for (const pcl::index_t i : visited) {
    const PointT& p = cloud[i];
    const bool passes = scores[ColorTable::cell(p.b, p.g, p.r)] > threshold;
    kept[n_kept] = i;
    n_kept += static_cast<unsigned>(passes == wanted) & static_cast<unsigned>(pcl::isFinite(p));
  }
  listRemoved(n_kept);
  indices.assign(kept, kept + n_kept);
}

template <typename PointT>
void AppearanceFilter<PointT>::listRemoved(std::size_t n_kept) {
  removed_indices_->clear();
  if (!extract_removed_indices_) return;
  // The kept indices are in the order of the visited ones: what is not the next of them was
  // removed.
  const pcl::Indices& visited = *indices_;
  if (removed_.size() < visited.size()) removed_.resize(visited.size());
  std::size_t n_removed = 0;
  std::size_t next = 0;
  for (const pcl::index_t i : visited) {
    const unsigned is_kept =
        static_cast<unsigned>(next < n_kept) & static_cast<unsigned>(kept_[next] == i);
    removed_[n_removed] = i;
    n_removed += 1 - is_kept;
    next += is_kept;
  }
  removed_indices_->assign(removed_.data(), removed_.data() + n_removed);
}

}  // namespace heel

// The name is only pasted by PCL_INSTANTIATE, so a foreign namespace is fine.
#define PCL_INSTANTIATE_AppearanceFilter(T) template class PCL_EXPORTS heel::AppearanceFilter<T>;
