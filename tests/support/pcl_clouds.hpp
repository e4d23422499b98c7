// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Small clouds, in files as PCL writes them.
#pragma once

#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cstdint>
#include <filesystem>
#include <limits>

namespace heel::test {

/// Points that all differ, and colours where there are any; the first point is NaN.
template <typename PointT>
pcl::PointCloud<PointT> someCloud(std::uint32_t width = 8, std::uint32_t height = 6) {
  pcl::PointCloud<PointT> cloud(width, height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto k = static_cast<float>(i);
    cloud[i].getVector3fMap() = Eigen::Vector3f(0.1F * k, -0.2F * k, 1.0F + k);
    if constexpr (pcl::traits::has_color<PointT>::value) {
      cloud[i].r = static_cast<std::uint8_t>(i);
      cloud[i].g = static_cast<std::uint8_t>(100 + i);
      cloud[i].b = static_cast<std::uint8_t>(200 + i);
    }
  }
  cloud[0].getVector3fMap().setConstant(std::numeric_limits<float>::quiet_NaN());
  cloud.is_dense = false;
  return cloud;
}

/// @param file  Its ending says whether it is PCD or PLY.
template <typename PointT>
void save(const std::filesystem::path& file, const pcl::PointCloud<PointT>& cloud,
          CloudEncoding encoding) {
  if (file.extension() == ".ply") {
    pcl::PLYWriter().write(file.string(), cloud, encoding == CloudEncoding::kBinary);
  } else if (encoding == CloudEncoding::kAscii) {
    pcl::PCDWriter().writeASCII(file.string(), cloud, 9);
  } else if (encoding == CloudEncoding::kBinary) {
    pcl::PCDWriter().writeBinary(file.string(), cloud);
  } else {
    pcl::PCDWriter().writeBinaryCompressed(file.string(), cloud);
  }
}

}  // namespace heel::test
