// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The filter on a point type that is not PCL's, with the bodies included as PCL's users do.
#define PCL_NO_PRECOMPILE

#include "tests/support/pcl_filter_contract.hpp"
#include <heel/cloud/color_cloud.hpp>
#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/plan_view.hpp>

#include <pcl/register_point_struct.h>

#include <cstdint>

namespace heel::test {

/// Plain members, no padding, no packed `rgb`.
struct PaintedPoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t coats = 3;
};

}  // namespace heel::test

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(heel::test::PaintedPoint,
    (float, x, x)(float, y, y)(float, z, z)
    (std::uint8_t, r, r)(std::uint8_t, g, g)(std::uint8_t, b, b)(std::uint8_t, coats, coats))
// clang-format on

namespace heel::test {
namespace {

struct OwnPointCase {
  using Point = PaintedPoint;
  using Filter = AppearanceFilter<PaintedPoint>;
  static void setUp(Filter& filter) {
    filter.setTable(ColorTable([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; }));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(AppearanceFilterOnAPointOfOnesOwn, PclFilterContract, OwnPointCase);

TEST(PlanViewOfAPointOfOnesOwn, IsAsThatOfPclsPoints) {
  const ColorTable red([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; });
  const ColorCloud colors = *makeScene<pcl::PointXYZRGB>(3);
  pcl::PointCloud<PaintedPoint> cloud;
  for (const auto& p : colors) cloud.push_back({p.x, p.y, p.z, p.r, p.g, p.b, 1});
  PlanView view;
  PlanView expected;
  view.build(cloud, allIndices(cloud.size()), &red);
  expected.build(colors, allIndices(colors.size()), &red);
  EXPECT_GT(view.points(), 20);
  ASSERT_EQ(view.occupied(), expected.occupied());
  for (const int cell : view.occupied()) {
    EXPECT_EQ(view[cell].points, expected[cell].points);
    EXPECT_EQ(view[cell].max_height_m, expected[cell].max_height_m);
    EXPECT_EQ(view[cell].area_m2, expected[cell].area_m2);
    EXPECT_EQ(view[cell].appearance, expected[cell].appearance);
  }
}

}  // namespace
}  // namespace heel::test
