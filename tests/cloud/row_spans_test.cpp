// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/row_spans.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cstdint>

namespace heel {
namespace {

TEST(RowSpans, FindsEveryRunOfARow) {
  cv::Mat1b mask(3, 20, std::uint8_t{0});
  mask.row(1).colRange(0, 2) = 255;
  mask.row(1).colRange(5, 6) = 1;
  mask.row(1).colRange(12, 20) = 255;
  RowSpans spans;
  spans.find(mask);
  EXPECT_TRUE(spans.row(0).empty());
  EXPECT_TRUE(spans.row(2).empty());
  ASSERT_EQ(spans.row(1).end() - spans.row(1).begin(), 3);
  const Span* run = spans.row(1).begin();
  EXPECT_EQ(run[0].begin, 0);
  EXPECT_EQ(run[0].end, 2);
  EXPECT_EQ(run[1].begin, 5);
  EXPECT_EQ(run[1].end, 6);
  EXPECT_EQ(run[2].begin, 12);
  EXPECT_EQ(run[2].end, 20);
  EXPECT_EQ(spans.bounds(), cv::Rect(0, 1, 20, 1));
}

TEST(RowSpans, CoversExactlyTheSetPixelsOfARandomMask) {
  cv::RNG random(3);
  cv::Mat1b mask(50, 77);
  random.fill(mask, cv::RNG::UNIFORM, 0, 3);
  RowSpans spans;
  spans.find(mask);
  cv::Mat1b covered(mask.size(), std::uint8_t{0});
  for (int y = 0; y < mask.rows; ++y) {
    for (const Span& span : spans.row(y)) covered.row(y).colRange(span.begin, span.end) = 255;
  }
  EXPECT_EQ(cv::countNonZero(covered != (mask != 0)), 0);
}

TEST(RowSpans, HasNoBoundsWithoutPixels) {
  RowSpans spans;
  spans.find(cv::Mat1b(4, 9, std::uint8_t{0}));
  EXPECT_TRUE(spans.bounds().empty());
}

}  // namespace
}  // namespace heel
