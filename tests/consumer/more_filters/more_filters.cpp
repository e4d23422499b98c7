// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// clang-format off
//! [own point]
#define PCL_NO_PRECOMPILE  // first of all, as for PCL's own filters
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

struct EIGEN_ALIGN16 GradedPoint {
  PCL_ADD_POINT4D
  PCL_ADD_RGB
  float confidence = 1.0F;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT(GradedPoint,
    (float, x, x)(float, y, y)(float, z, z)(float, rgb, rgb)(float, confidence, confidence))

#include <heel/segmentation/appearance_filter.hpp>
//! [own point]
// clang-format on

#include <heel/segmentation/appearance_model_io.hpp>

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#define CHECK(holds)                                                   \
  do {                                                                 \
    if (!(holds)) {                                                    \
      std::fprintf(stderr, "line %d: not so: %s\n", __LINE__, #holds); \
      std::exit(1);                                                    \
    }                                                                  \
  } while (false)

/// more_filters person.yaml SCENE.pcd: other ways to use the filter, on what learn_from_points
/// made.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const char* const file = argv[2];

  //! [reuse]
  const heel::AppearanceModel model = heel::loadAppearance(argv[1]);
  const heel::ColorTable table = model.filterTable();  // make it once; copies share its 864 KiB
  const bool keeps_red = table.passes(30, 30, 200);    // a colour by itself: b, g, r
  //! [reuse]
  CHECK(keeps_red && !table.passes(190, 30, 40));

  //! [threshold]
  heel::AppearanceModel stricter = model;
  for (std::size_t band = 0; band < stricter.bands().size(); ++band) {
    const int now = stricter.bands()[band].table.threshold();
    stricter.setThreshold(band, static_cast<std::uint8_t>(std::min(now + 20, 254)));
  }
  const heel::ColorTable strict_table = stricter.filterTable();
  //! [threshold]
  CHECK(strict_table.passes(30, 30, 200) && !strict_table.passes(190, 30, 40));

  pcl::Indices indices;
  {
    const pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZRGB>);
    pcl::io::loadPCDFile(file, *cloud);
    //! [filter]
    heel::AppearanceFilter<pcl::PointXYZRGB> filter;  // a pcl::FilterIndices, with all it promises
    filter.setTable(heel::loadAppearance("person.yaml").filterTable());
    filter.setInputCloud(cloud);
    filter.filter(indices);
    //! [filter]
  }

  //! [organized]
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZRGB>);
  pcl::io::loadPCDFile(file, *cloud);
  heel::AppearanceFilter<pcl::PointXYZRGB> filter(true);  // true: list what is removed
  filter.setTable(table);
  filter.setInputCloud(cloud);
  filter.setKeepOrganized(true);  // removed points become NaN, width and height stay
  pcl::PointCloud<pcl::PointXYZRGB> same_shape;
  filter.filter(same_shape);
  const pcl::Indices& removed = *filter.getRemovedIndices();
  //! [organized]
  CHECK(same_shape.width == cloud->width && same_shape.height == cloud->height);
  int left = 0;
  for (const auto& point : same_shape) left += std::isfinite(point.z) ? 1 : 0;
  CHECK(left > 0 && static_cast<std::size_t>(left) == indices.size());
  CHECK(left + static_cast<int>(removed.size()) == static_cast<int>(cloud->size()));

  //! [blob]
  pcl::PCLPointCloud2::Ptr blob(new pcl::PCLPointCloud2);
  pcl::io::loadPCDFile(file, *blob);
  heel::AppearanceFilter<pcl::PCLPointCloud2> blob_filter;
  blob_filter.setTable(table);
  blob_filter.setInputCloud(blob);
  pcl::PCLPointCloud2 person;  // with all the fields that `blob` has
  blob_filter.filter(person);
  //! [blob]
  CHECK(static_cast<int>(person.width * person.height) == left);

  pcl::PointCloud<GradedPoint>::Ptr graded(new pcl::PointCloud<GradedPoint>);
  pcl::copyPointCloud(*cloud, *graded);
  heel::AppearanceFilter<GradedPoint> own;
  own.setTable(table);
  own.setInputCloud(graded);
  pcl::Indices kept;
  own.filter(kept);
  CHECK(static_cast<int>(kept.size()) == left);
  std::printf("%d points of the person, each way\n", left);
  return 0;
}
