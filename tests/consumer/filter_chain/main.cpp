// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "chain.hpp"
#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

namespace consumer {

/// The filter on a cloud as it comes from a file or a message.
void runOnBlob() {
  const pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*makeVoxels<pcl::PointXYZRGB>(), *cloud);
  heel::AppearanceFilter<pcl::PCLPointCloud2> by_color;
  by_color.setTable(redTable());
  by_color.setInputCloud(cloud);
  pcl::PCLPointCloud2 out;
  by_color.filter(out);
  CHECK(out.width == kPerson + kSpecks);
  CHECK(out.data.size() == out.width * sizeof(pcl::PointXYZRGB));
  by_color.setNegative(true);
  by_color.filter(out);
  CHECK(out.width == kWall);
}

}  // namespace consumer

int main() {
  consumer::runChain<pcl::PointXYZRGB>();
  consumer::runChain<pcl::PointXYZRGBA>();
  consumer::runChainOnOwnPoint();
  consumer::runOnBlob();
  std::printf("the filter chain gives what it must\n");
  return 0;
}
