// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/drawn_floor.hpp"
#include <heel/segmentation/height_crop.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using test::pointAt;
using testing::ElementsAre;
using testing::IsEmpty;

ColorCloud::Ptr ladder() {
  ColorCloud::Ptr cloud(new ColorCloud);
  for (const double z : {0.1, 0.5, 1.0, 2.0, 2.5}) cloud->push_back(pointAt(1.0, 0.0, z));
  cloud->push_back(pointAt(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0));
  return cloud;
}

TEST(HeightCrop, KeepsAPersonsHeights) {
  pcl::Indices kept;
  HeightCrop crop;
  crop.apply(ladder(), nullptr, kept);
  EXPECT_THAT(kept, ElementsAre(1, 2, 3));
}

TEST(HeightCrop, HonoursIndicesAndTheirOrder) {
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{3, 0, 1, 5});
  pcl::Indices kept;
  HeightCrop crop;
  crop.apply(ladder(), indices, kept);
  EXPECT_THAT(kept, ElementsAre(3, 1));
  crop.apply(ladder(), nullptr, kept);  // the last call's indices are forgotten
  EXPECT_THAT(kept, ElementsAre(1, 2, 3));
}

TEST(HeightCrop, OutputMayBeTheIndicesThemselves) {
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{4, 3, 2});
  HeightCrop crop;
  crop.apply(ladder(), indices, *indices);
  EXPECT_THAT(*indices, ElementsAre(3, 2));
}

TEST(HeightCrop, NothingInNothingOut) {
  pcl::Indices kept{1, 2};
  HeightCrop crop;
  crop.apply(pcl::make_shared<ColorCloud>(), nullptr, kept);
  EXPECT_THAT(kept, IsEmpty());
  kept = {1};
  crop.apply(nullptr, nullptr, kept);
  EXPECT_THAT(kept, IsEmpty());
  kept = {1};
  crop.apply(ladder(), pcl::make_shared<pcl::Indices>(), kept);
  EXPECT_THAT(kept, IsEmpty());
}

TEST(HeightCrop, RefusesSenselessLimits) {
  EXPECT_THROW(HeightCrop({2.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(HeightCrop({1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(HeightCrop({std::nan(""), 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
