// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_cloud.hpp>
#include <heel/apps/recording/clouds/cloud_places.hpp>

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

void checkFields(const pcl::PCLPointCloud2& blob) {
  const std::string wrong = wrongWithPlaces(blob);
  if (!wrong.empty()) throw std::runtime_error(wrong);
  if (pcl::getFieldIndex(blob, "rgb") < 0 && pcl::getFieldIndex(blob, "rgba") < 0) {
    throw std::runtime_error("the cloud has no colour (no field rgb or rgba)");
  }
  for (const pcl::PCLPointField& field : blob.fields) {
    const auto size = static_cast<std::uint64_t>(std::max(pcl::getFieldSize(field.datatype), 0));
    if (field.offset + size * std::max<std::uint64_t>(field.count, 1) > blob.point_step) {
      throw std::runtime_error("the field " + field.name + " is not within a point");
    }
  }
}

}  // namespace

ColorCloud::ConstPtr toColorCloud(const PointCloud2Msg& message) {
  pcl::PCLPointCloud2 blob;
  blob.height = message.height;
  blob.width = message.width;
  blob.point_step = message.point_step;
  blob.row_step = message.row_step;
  blob.is_dense = message.is_dense ? 1 : 0;
  for (const PointFieldMsg& field : message.points_fields) {
    blob.fields.push_back({});
    blob.fields.back().name = field.name;
    blob.fields.back().offset = field.offset;
    blob.fields.back().datatype = field.datatype;
    blob.fields.back().count = field.count;
  }
  if (message.is_bigendian) throw std::runtime_error("the cloud is big-endian, which is not read");
  checkFields(blob);
  const std::size_t row = std::size_t{blob.width} * blob.point_step;
  if (row == 0 || blob.height == 0) throw std::runtime_error("the cloud is empty (0 points)");
  if (blob.row_step < row || message.data.size() / blob.row_step < blob.height) {
    throw std::runtime_error("the cloud has fewer bytes than its size needs");
  }
  blob.data = message.data;
  makePlacesShort(blob);
  const auto cloud = pcl::make_shared<ColorCloud>();
  pcl::fromPCLPointCloud2(blob, *cloud);
  if (std::none_of(cloud->begin(), cloud->end(), [](const auto& p) { return pcl::isFinite(p); })) {
    throw std::runtime_error("all points of the cloud are NaN");
  }
  return cloud;
}

PointCloud2Msg toCloudMsg(const ColorCloud& cloud) {
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  PointCloud2Msg message;
  message.height = blob.height;
  message.width = blob.width;
  for (const pcl::PCLPointField& field : blob.fields) {
    message.points_fields.push_back({field.name, field.offset, field.datatype, field.count});
  }
  message.point_step = blob.point_step;
  message.row_step = blob.row_step;
  message.data.assign(blob.data.begin(), blob.data.end());
  message.is_dense = cloud.is_dense;
  return message;
}

}  // namespace heel
