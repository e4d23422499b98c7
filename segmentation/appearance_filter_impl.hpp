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
  // end of a list, and only the end moves on: no branch depends on a noisy image, which halves the
  // time.
  const std::size_t n = indices_->size();
  if (kept_.size() < n) kept_.resize(n);
  if (extract_removed_indices_ && removed_.size() < n) removed_.resize(n);
  auto kept_end = kept_.begin();
  auto removed_end = removed_.begin();
  const PointCloud& cloud = *input_;
  const std::uint8_t* scores = table_.data();
  const std::uint8_t threshold = table_.threshold();
  const bool wanted = !negative_;
  const bool list_removed = extract_removed_indices_;
  for (const pcl::index_t i : *indices_) {
    const PointT& p = cloud[i];
    const bool passes = scores[ColorTable::cell(p.b, p.g, p.r)] > threshold;
    const int keep = static_cast<int>(passes == wanted) & static_cast<int>(pcl::isFinite(p));
    *kept_end = i;
    kept_end += keep;
    if (list_removed) {
      *removed_end = i;
      removed_end += 1 - keep;
    }
  }
  indices.assign(kept_.begin(), kept_end);
  removed_indices_->assign(removed_.begin(), removed_end);
}

}  // namespace heel

// The name is only pasted by PCL_INSTANTIATE, so a foreign namespace is fine.
#define PCL_INSTANTIATE_AppearanceFilter(T) template class PCL_EXPORTS heel::AppearanceFilter<T>;
