// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/pcl_filter_contract.hpp"
#include <heel/segmentation/appearance_filter.hpp>

#include <gtest/gtest.h>
#include <pcl/filters/crop_box.h>
#include <pcl/filters/passthrough.h>
#include <pcl/point_types.h>

#include <limits>

namespace heel {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;

ColorTable redTable() {
  return ColorTable([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; });
}

template <typename PointT>
struct AppearanceCase {
  using Point = PointT;
  using Filter = AppearanceFilter<PointT>;
  static void setUp(Filter& filter) { filter.setTable(redTable()); }
};

/// Shows that the laws are PCL's and not only ours.
struct PassThroughCase {
  using Point = pcl::PointXYZRGB;
  using Filter = pcl::PassThrough<Point>;
  static void setUp(Filter& filter) {
    filter.setFilterFieldName("x");
    filter.setFilterLimits(-0.5F, 0.5F);
  }
};

/// Shows that the suite can fail.
struct CropBoxCase {
  using Point = pcl::PointXYZRGB;
  using Filter = pcl::CropBox<Point>;
  static void setUp(Filter& filter) {
    filter.setMin({-0.5F, -0.5F, -0.5F, 1.0F});
    filter.setMax({0.5F, 0.5F, 0.5F, 1.0F});
  }
};

}  // namespace

namespace test {

using AppearanceCases =
    testing::Types<AppearanceCase<pcl::PointXYZRGB>, AppearanceCase<pcl::PointXYZRGBA>,
                   AppearanceCase<pcl::PointXYZRGBL>, AppearanceCase<pcl::PointXYZRGBNormal>,
                   AppearanceCase<pcl::PointSurfel>>;
INSTANTIATE_TYPED_TEST_SUITE_P(AppearanceFilter, PclFilterContract, AppearanceCases);
INSTANTIATE_TYPED_TEST_SUITE_P(PositiveControlPassThrough, PclFilterContract, PassThroughCase);

TEST(PclFilterContractControl, CropBoxLosesNonFinitePointsAndFails) {
  const testing::AssertionResult law = keptAndRemovedPartitionTheInput<CropBoxCase>();
  if (law) GTEST_SKIP() << "this PCL's CropBox keeps the law: the suite needs another control";
  EXPECT_THAT(law.message(), testing::HasSubstr("kept and"));
}

}  // namespace test

namespace {

Cloud::Ptr redScale() {
  auto cloud = pcl::make_shared<Cloud>();
  for (const int r : {0, 28, 29, 30, 31}) {
    cloud->emplace_back(0.0F, 0.0F, 1.0F, static_cast<std::uint8_t>(r), std::uint8_t{200},
                        std::uint8_t{9});
  }
  return cloud;
}

pcl::Indices filtered(AppearanceFilter<pcl::PointXYZRGB>& filter) {
  pcl::Indices indices;
  filter.filter(indices);
  return indices;
}

TEST(AppearanceFilter, KeepsScoresAboveTheThresholdOnly) {
  AppearanceFilter<pcl::PointXYZRGB> filter;
  filter.setInputCloud(redScale());
  filter.setTable(redTable().withThreshold(29));
  EXPECT_EQ(filtered(filter), (pcl::Indices{3, 4}));  // 29 is at the threshold, not above it
  filter.setNegative(true);
  EXPECT_EQ(filtered(filter), (pcl::Indices{0, 1, 2}));
  EXPECT_EQ(filter.getTable().threshold(), 29);
}

TEST(AppearanceFilter, ThresholdsAtTheEndsOfTheScale) {
  AppearanceFilter<pcl::PointXYZRGB> filter;
  filter.setInputCloud(redScale());
  filter.setTable(redTable().withThreshold(0));
  EXPECT_EQ(filtered(filter), (pcl::Indices{1, 2, 3, 4}));  // a score of 0 never passes
  filter.setTable(redTable().withThreshold(255));
  EXPECT_TRUE(filtered(filter).empty());
}

TEST(AppearanceFilter, AgreesWithTheTableOnEveryFinitePoint) {
  const ColorTable table([](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return static_cast<std::uint8_t>(3 * b + 5 * g + 7 * r);
  });
  AppearanceFilter<pcl::PointXYZRGB> filter;
  filter.setTable(table);
  const auto cloud = test::makeScene<pcl::PointXYZRGB>(4);
  filter.setInputCloud(cloud);
  pcl::Indices expected;
  for (const auto i : test::allIndices(cloud->size())) {
    const auto& p = (*cloud)[i];
    if (pcl::isFinite(p) && table.passes(p.b, p.g, p.r)) expected.push_back(i);
  }
  EXPECT_EQ(filtered(filter), expected);
}

TEST(AppearanceFilter, WithoutATableReportsAnErrorAndKeepsNothing) {
  const test::QuietPcl quiet;
  AppearanceFilter<pcl::PointXYZRGB> filter(true);
  filter.setInputCloud(redScale());
  filter.setTable(redTable().withThreshold(29));
  EXPECT_FALSE(filtered(filter).empty());
  filter.setTable(ColorTable());
  for (const bool negative : {false, true}) {
    filter.setNegative(negative);
    pcl::Indices indices = {3, 1};
    filter.filter(indices);
    EXPECT_TRUE(indices.empty());
    EXPECT_TRUE(filter.getRemovedIndices()->empty());
  }
  Cloud out;
  filter.filter(out);
  EXPECT_TRUE(out.empty());
}

TEST(AppearanceFilter, ACloudOfNaNKeepsNothing) {
  const auto cloud = redScale();
  for (auto& p : *cloud) p.y = std::numeric_limits<float>::quiet_NaN();
  AppearanceFilter<pcl::PointXYZRGB> filter(true);
  filter.setInputCloud(cloud);
  filter.setTable(redTable().withThreshold(0));
  EXPECT_TRUE(filtered(filter).empty());
  EXPECT_EQ(filter.getRemovedIndices()->size(), cloud->size());
}

TEST(AppearanceFilter, GivesItsNameAsPclFiltersDo) {
  struct Named : AppearanceFilter<pcl::PointXYZRGB> {
    using AppearanceFilter::getClassName;
  };
  EXPECT_EQ(Named().getClassName(), "AppearanceFilter");
}

}  // namespace
}  // namespace heel
