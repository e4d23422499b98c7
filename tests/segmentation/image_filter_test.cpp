// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/image_filter.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

/// Scores that differ between all neighbouring cells and depend on every channel.
const ColorTable& table() {
  static const ColorTable scores(
      [](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
        return static_cast<std::uint8_t>((31 * b + 57 * g + 101 * r) / 4);
      },
      100);
  return scores;
}

cv::Mat randomImage(int rows, int cols) {
  cv::Mat image(rows, cols, CV_8UC3);
  cv::RNG random(7);
  if (!image.empty()) random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

void expectMaskOf(const cv::Mat& image, const cv::Mat& mask) {
  ASSERT_EQ(mask.type(), CV_8UC1);
  ASSERT_EQ(mask.size(), image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto& p = image.at<cv::Vec3b>(y, x);
      ASSERT_EQ(mask.at<std::uint8_t>(y, x), table().passes(p[0], p[1], p[2]) ? 255 : 0)
          << "at row " << y << ", column " << x;
    }
  }
}

TEST(ImageFilter, AgreesWithTheTableOnEveryColor) {
  cv::Mat image(4096, 4096, CV_8UC3);
  int color = 0;
  for (auto p = image.begin<cv::Vec3b>(); p != image.end<cv::Vec3b>(); ++p, ++color) {
    *p = {static_cast<std::uint8_t>(color), static_cast<std::uint8_t>(color >> 8),
          static_cast<std::uint8_t>(color >> 16)};
  }
  cv::Mat mask;
  filterImage(image, table(), mask);
  expectMaskOf(image, mask);
}

TEST(ImageFilter, AgreesWithTheCloudFormPixelByPixel) {
  const cv::Mat image = randomImage(48, 64);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>(64, 48);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto& p = image.at<cv::Vec3b>(static_cast<int>(i));
    cloud->points[i] = pcl::PointXYZRGB(0.0F, 0.0F, 1.0F, p[2], p[1], p[0]);
  }
  AppearanceFilter<pcl::PointXYZRGB> filter;
  filter.setTable(table());
  filter.setInputCloud(cloud);
  pcl::Indices kept;
  filter.filter(kept);
  cv::Mat expected(48, 64, CV_8UC1, cv::Scalar(0));
  for (const auto i : kept) expected.data[i] = 255;

  cv::Mat mask;
  filterImage(image, table(), mask);
  EXPECT_EQ(cv::countNonZero(mask != expected), 0);
  EXPECT_GT(cv::countNonZero(mask), 0);
  EXPECT_LT(cv::countNonZero(mask), 48 * 64);
}

TEST(ImageFilter, TakesImagesOfAnyWidthAndReadsNothingBehindThem) {
  for (int cols = 0; cols < 40; ++cols) {
    // Memory of just this size: a sanitizer sees what is read behind it.
    const cv::Mat source = randomImage(2, cols);
    std::vector<std::uint8_t> memory(source.datastart, source.dataend);
    const cv::Mat image(2, cols, CV_8UC3, memory.data());
    cv::Mat mask;
    filterImage(image, table(), mask);
    expectMaskOf(image, mask);
  }
}

TEST(ImageFilter, TakesARegionOfAnImageAndFillsARegionOfAMask) {
  const cv::Mat image = randomImage(40, 60);
  const cv::Rect region(3, 5, 41, 30);
  cv::Mat whole(40, 60, CV_8UC1, cv::Scalar(9));
  cv::Mat mask = whole(region);
  filterImage(image(region), table(), mask);
  EXPECT_EQ(mask.data, whole(region).data);
  expectMaskOf(image(region), mask);
  mask.setTo(9);
  EXPECT_EQ(cv::countNonZero(whole != 9), 0);  // nothing outside the region was touched
}

TEST(ImageFilter, ReusesTheMemoryOfTheMask) {
  cv::Mat mask;
  filterImage(randomImage(20, 30), table(), mask);
  const auto* memory = mask.data;
  filterImage(randomImage(20, 30), table(), mask);
  EXPECT_EQ(mask.data, memory);
}

TEST(ImageFilter, TheImageMayBeTheMaskItself) {
  const cv::Mat image = randomImage(20, 30);
  cv::Mat both = image.clone();
  filterImage(both, table(), both);
  expectMaskOf(image, both);
}

TEST(ImageFilter, RejectsWhatItCannotFilter) {
  cv::Mat mask;
  EXPECT_THROW(filterImage(cv::Mat(), table(), mask), std::invalid_argument);
  EXPECT_THROW(filterImage(cv::Mat(4, 4, CV_8UC1), table(), mask), std::invalid_argument);
  EXPECT_THROW(filterImage(cv::Mat(4, 4, CV_8UC4), table(), mask), std::invalid_argument);
  EXPECT_THROW(filterImage(randomImage(4, 4), ColorTable(), mask), std::invalid_argument);
}

}  // namespace
}  // namespace heel
