// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/row_spans.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cstdint>

namespace heel {
namespace {

TEST(MaskSupport, DropsSpecksAndKeepsBodies) {
  cv::Mat1b mask(120, 160, std::uint8_t{0});
  const cv::Rect body(50, 30, 20, 60);
  mask(body) = 1;
  mask(10, 10) = 255;
  mask(cv::Rect(130, 100, 3, 3)) = 255;
  cv::Mat kept;
  std::vector<int> cells;
  const SupportCount count = keepSupported(mask, 0.1, kept, cells);
  EXPECT_EQ(count.wanted, body.area() + 1 + 9);
  EXPECT_EQ(count.kept, body.area());
  EXPECT_EQ(cv::countNonZero(kept), body.area());
  EXPECT_EQ(cv::countNonZero(kept(body)), body.area());
}

TEST(MaskSupport, KeepsADenseScatterOnABody) {
  cv::Mat1b mask(96, 96, std::uint8_t{0});
  for (int y = 24; y < 72; y += 2) {
    for (int x = 24; x < 72; x += 2) mask(y, x) = 255;  // one pixel in four, none adjacent
  }
  cv::Mat kept;
  std::vector<int> cells;
  const SupportCount count = keepSupported(mask, 0.1, kept, cells);
  EXPECT_EQ(count.kept, count.wanted);
}

TEST(MaskSupport, KeepsEverythingWhenNoShareIsAsked) {
  cv::Mat1b mask(11, 13, std::uint8_t{0});
  mask(10, 12) = 1;
  cv::Mat kept;
  std::vector<int> cells;
  EXPECT_EQ(keepSupported(mask, 0.0, kept, cells).kept, 1);
  EXPECT_EQ(kept.at<std::uint8_t>(10, 12), 255);
}

TEST(MaskSupport, CountsOnlyTheImageAroundAPixelAtTheBorder) {
  cv::Mat1b mask(80, 80, std::uint8_t{0});
  mask(cv::Rect(0, 0, 6, 6)) = 255;  // 36 of the 16x16 px that the image has there: 14 %
  cv::Mat kept;
  std::vector<int> cells;
  EXPECT_EQ(keepSupported(mask, 0.1, kept, cells).kept, 36);
  EXPECT_EQ(keepSupported(mask, 0.2, kept, cells).kept, 0);
}

}  // namespace
}  // namespace heel
