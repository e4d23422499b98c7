// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance filter on a point cloud (paper, section 3.1), as a PCL filter.
#pragma once

#include <heel/segmentation/color_table.hpp>

#include <pcl/PCLPointCloud2.h>
#include <pcl/filters/filter_indices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <cstddef>

namespace heel {

/// Keeps the points whose colour passes a ColorTable, whichever appearance model made it.
///
/// Behaves as any pcl::FilterIndices: honours setIndices, setNegative, setKeepOrganized,
/// setUserFilterValue and getRemovedIndices. Points with non-finite x, y or z are always removed.
/// Without a table it reports a PCL_ERROR and both its lists are empty. `filter(Indices&)` on one
/// cloud after another allocates nothing once its lists have grown; PCL's `filter(PointCloud&)` on
/// top of it does.
///
/// @tparam PointT  A PCL point with x, y, z, r, g, b. Instantiated for all of PCL's own; for
///                 another, `#define PCL_NO_PRECOMPILE` before including this.
template <typename PointT>
class AppearanceFilter : public pcl::FilterIndices<PointT> {
  using Base = pcl::FilterIndices<PointT>;

 public:
  using Ptr = pcl::shared_ptr<AppearanceFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const AppearanceFilter<PointT>>;
  using PointCloud = typename Base::PointCloud;

  /// @param extract_removed_indices  Set to read getRemovedIndices() afterwards.
  explicit AppearanceFilter(bool extract_removed_indices = false);

  /// Which colours to keep: those above the table's threshold.
  void setTable(const ColorTable& table) { table_ = table; }
  const ColorTable& getTable() const { return table_; }

 protected:
  using Base::applyFilter;  // keeps applyFilter(PointCloud&) visible
  using Base::extract_removed_indices_;
  using Base::filter_name_;
  using Base::indices_;
  using Base::input_;
  using Base::negative_;
  using Base::removed_indices_;

  void applyFilter(pcl::Indices& indices) override;

 private:
  /// Fills kept_ (and removed_, if it is wanted); returns how many are kept.
  template <bool kListRemoved>
  std::size_t select();

  ColorTable table_;
  pcl::Indices kept_;     // Workspace: as long as the longest list so far.
  pcl::Indices removed_;  // The same.
};

/// The same on a cloud as it travels and is stored: the typed filter's answers, and every field of
/// the kept points survives.
///
/// The cloud needs fields x, y, z (FLOAT32) and rgb or rgba (FLOAT32 or UINT32, the bytes b, g, r,
/// a), anywhere in a point; byte order is this machine's, rows are not padded. Without them, or
/// without a table, it reports a PCL_ERROR and keeps nothing: lists and cloud are empty, organized
/// or not. setKeepOrganized overwrites x, y, z of the removed points and nothing else.
template <>
class AppearanceFilter<pcl::PCLPointCloud2> : public pcl::FilterIndices<pcl::PCLPointCloud2> {
  using Base = pcl::FilterIndices<pcl::PCLPointCloud2>;

 public:
  using Ptr = pcl::shared_ptr<AppearanceFilter<pcl::PCLPointCloud2>>;
  using ConstPtr = pcl::shared_ptr<const AppearanceFilter<pcl::PCLPointCloud2>>;

  /// @param extract_removed_indices  Set to read getRemovedIndices() afterwards.
  explicit AppearanceFilter(bool extract_removed_indices = false);
  /// A copy has the same settings, and lists and a workspace of its own.
  AppearanceFilter(const AppearanceFilter& other);
  AppearanceFilter& operator=(const AppearanceFilter& other);

  /// Which colours to keep: those above the table's threshold.
  void setTable(const ColorTable& table) { typed_.setTable(table); }
  const ColorTable& getTable() const { return typed_.getTable(); }

 protected:
  void applyFilter(pcl::Indices& indices) override;
  void applyFilter(pcl::PCLPointCloud2& output) override;

 private:
  /// Fills `kept` and typed_'s removed indices; false, with a PCL_ERROR, if that can't be done.
  bool select(pcl::Indices& kept);

  AppearanceFilter<pcl::PointXYZRGBA> typed_;
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr points_;  // Of the input: what typed_ looks at.
};

}  // namespace heel

#ifdef PCL_NO_PRECOMPILE  // users with a point type of their own get the bodies
#include <heel/segmentation/appearance_filter_impl.hpp>
#endif
