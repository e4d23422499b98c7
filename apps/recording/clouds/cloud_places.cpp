// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/cloud_places.hpp>

#include <pcl/common/io.h>

#include <cstring>

namespace heel {
namespace {

void makeShort(pcl::PCLPointField& field, pcl::PCLPointCloud2& cloud) {
  field.datatype = pcl::PCLPointField::FLOAT32;
  cloud.is_dense = 0;  // a float of 32 bits may be infinite where one of 64 is not
  for (std::size_t v = 0; v < cloud.height; ++v) {
    for (std::size_t u = 0; u < cloud.width; ++u) {
      auto* at = &cloud.data[v * cloud.row_step + u * cloud.point_step + field.offset];
      double value = 0.0;
      std::memcpy(&value, at, sizeof value);
      const auto shorter = static_cast<float>(value);
      std::memcpy(at, &shorter, sizeof shorter);
    }
  }
}

}  // namespace

std::string wrongWithPlaces(const pcl::PCLPointCloud2& layout) {
  for (const char* axis : {"x", "y", "z"}) {
    const int index = pcl::getFieldIndex(layout, axis);
    if (index < 0) return "the cloud has no fields x, y and z";
    const auto type = layout.fields[static_cast<std::size_t>(index)].datatype;
    if (type != pcl::PCLPointField::FLOAT32 && type != pcl::PCLPointField::FLOAT64) {
      return std::string("the field ") + axis + " does not hold floats (of 32 or 64 bits)";
    }
  }
  return "";
}

void makePlacesShort(pcl::PCLPointCloud2& cloud) {
  for (pcl::PCLPointField& field : cloud.fields) {  // The bytes of a colour are no number.
    const bool is_color = field.name == "rgb" || field.name == "rgba";
    if (is_color && field.datatype == pcl::PCLPointField::INT32) {
      field.datatype = pcl::PCLPointField::UINT32;
    }
  }
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"}) {
    const int index = pcl::getFieldIndex(cloud, name);
    if (index < 0) continue;
    pcl::PCLPointField& field = cloud.fields[static_cast<std::size_t>(index)];
    if (field.datatype == pcl::PCLPointField::FLOAT64 && field.count <= 1) makeShort(field, cloud);
  }
}

}  // namespace heel
