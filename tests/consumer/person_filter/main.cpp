// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cstdio>
#include <exception>
#include <string>

/// person_filter MODEL IN.pcd OUT.pcd: the points that have the person's colours, without specks.
int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  using Point = pcl::PointXYZRGB;
  const pcl::PointCloud<Point>::Ptr cloud(new pcl::PointCloud<Point>);
  if (pcl::io::loadPCDFile(argv[2], *cloud) != 0) return 1;

  const heel::AppearanceModel model = heel::loadAppearance(argv[1]);
  const std::string advice = model.separability().advice;  // empty if all is well
  if (!advice.empty()) std::printf("%s\n", advice.c_str());

  heel::AppearanceFilter<Point> by_color;
  by_color.setTable(model.filterTable());
  by_color.setInputCloud(cloud);
  const pcl::IndicesPtr kept(new pcl::Indices);
  by_color.filter(*kept);

  pcl::StatisticalOutlierRemoval<Point> no_specks;
  no_specks.setMeanK(8);
  no_specks.setStddevMulThresh(1.0);
  no_specks.setInputCloud(cloud);
  no_specks.setIndices(kept);
  pcl::PointCloud<Point> person;
  no_specks.filter(person);

  std::printf("%zu points; %zu of the person's colours; %zu without specks\n", cloud->size(),
              kept->size(), person.size());
  return pcl::io::savePCDFileBinaryCompressed(argv[3], person) == 0 ? 0 : 1;
} catch (const std::exception& error) {  // no model, say: its what() is a sentence for the user
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
