// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_filter.hpp>

#include <pcl/common/io.h>
#include <pcl/console/print.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

namespace heel {
namespace {

using Blob = pcl::PCLPointCloud2;
using Field = pcl::PCLPointField;

/// Where a point's bytes hold what the filter looks at.
struct Layout {
  std::array<std::size_t, 3> xyz;
  std::size_t rgb;
};

/// The offset of a single 4-byte value of that name and one of the types; none if there is none, or
/// if it does not lie within a point.
std::optional<std::size_t> offsetOf(const Blob& cloud, const std::string& name,
                                    bool may_be_integer) {
  for (const Field& field : cloud.fields) {
    const bool fits =
        field.datatype == Field::FLOAT32 || (may_be_integer && field.datatype == Field::UINT32);
    const bool is_single = field.count <= 1;  // 0 is an old way to say 1
    const std::size_t end = std::size_t{field.offset} + sizeof(float);
    if (field.name == name && fits && is_single && end <= cloud.point_step) return field.offset;
  }
  return std::nullopt;
}

std::optional<Layout> layoutOf(const Blob& cloud, std::string& problem) {
  const auto x = offsetOf(cloud, "x", false);
  const auto y = offsetOf(cloud, "y", false);
  const auto z = offsetOf(cloud, "z", false);
  auto rgb = offsetOf(cloud, "rgb", true);
  if (!rgb) rgb = offsetOf(cloud, "rgba", true);
  const std::size_t n_bytes = std::size_t{cloud.width} * cloud.height * cloud.point_step;
  if (!x || !y || !z) {
    problem = "the cloud has no fields x, y, z of type FLOAT32";
  } else if (!rgb) {
    problem = "the cloud has no field rgb or rgba of type FLOAT32 or UINT32";
  } else if (cloud.is_bigendian != Blob().is_bigendian) {
    problem = "the cloud's byte order is not this machine's";
  } else if (cloud.height > 1 &&
             std::size_t{cloud.row_step} != std::size_t{cloud.width} * cloud.point_step) {
    problem = "the cloud's rows are padded";
  } else if (cloud.data.size() < n_bytes) {
    problem = "the cloud's data are shorter than its width and height say";
  } else {
    return Layout{{*x, *y, *z}, *rgb};
  }
  return std::nullopt;
}

/// The points that `indices` names; the others are left as they are.
void readPoints(const Blob& cloud, const Layout& layout, const pcl::Indices& indices,
                pcl::PointCloud<pcl::PointXYZRGBA>& points) {
  points.resize(std::size_t{cloud.width} * cloud.height);
  for (const pcl::index_t i : indices) {
    const std::uint8_t* from = cloud.data.data() + static_cast<std::size_t>(i) * cloud.point_step;
    pcl::PointXYZRGBA& point = points[static_cast<std::size_t>(i)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::memcpy(&point.data[axis], from + layout.xyz[axis], sizeof(float));
    }
    std::memcpy(&point.rgba, from + layout.rgb, sizeof point.rgba);
  }
}

void empty(Blob& cloud) {
  cloud.width = cloud.height = cloud.row_step = 0;
  cloud.data.clear();
}

}  // namespace

AppearanceFilter<Blob>::AppearanceFilter(bool extract_removed_indices)
    : Base(extract_removed_indices),
      typed_(true),
      points_(pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGBA>>()) {
  filter_name_ = "AppearanceFilter";
}

AppearanceFilter<Blob>::AppearanceFilter(const AppearanceFilter& other) : AppearanceFilter() {
  *this = other;
}

AppearanceFilter<Blob>& AppearanceFilter<Blob>::operator=(const AppearanceFilter& other) {
  if (this == &other) return *this;
  Base::operator=(other);  // with which both have the same lists
  removed_indices_ = pcl::make_shared<pcl::Indices>(*other.removed_indices_);
  if (fake_indices_) indices_ = pcl::make_shared<pcl::Indices>();
  setTable(other.getTable());
  return *this;
}

bool AppearanceFilter<Blob>::select(pcl::Indices& kept) {
  std::string problem = getTable().empty() ? "No colour table given" : "";
  const auto layout = problem.empty() ? layoutOf(*input_, problem) : std::nullopt;
  if (!layout) {
    PCL_ERROR("[heel::%s::applyFilter] %s!\n", getClassName().c_str(), problem.c_str());
    removed_indices_->clear();
    kept.clear();
    return false;
  }
  readPoints(*input_, *layout, *indices_, *points_);
  typed_.setInputCloud(points_);
  typed_.setIndices(indices_);
  typed_.setNegative(negative_);
  typed_.filter(kept);
  return true;
}

void AppearanceFilter<Blob>::applyFilter(pcl::Indices& indices) {
  if (!select(indices)) return;
  removed_indices_->clear();
  if (extract_removed_indices_) *removed_indices_ = *typed_.getRemovedIndices();
}

void AppearanceFilter<Blob>::applyFilter(Blob& output) {
  pcl::Indices kept;
  if (!select(kept)) {
    empty(output);
    return;
  }
  if (extract_removed_indices_) *removed_indices_ = *typed_.getRemovedIndices();
  if (!keep_organized_) {
    pcl::copyPointCloud(*input_, kept, output);
    return;
  }
  output = *input_;
  std::string unused;
  const auto layout = layoutOf(output, unused);
  for (const pcl::index_t i : *typed_.getRemovedIndices()) {
    std::uint8_t* point = output.data.data() + static_cast<std::size_t>(i) * output.point_step;
    for (const std::size_t axis : layout->xyz) {
      std::memcpy(point + axis, &user_filter_value_, sizeof user_filter_value_);
    }
  }
  if (!std::isfinite(user_filter_value_)) output.is_dense = 0;
}

}  // namespace heel
