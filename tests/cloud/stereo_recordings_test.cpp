// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Matching on the real pairs, against their truth and against dense matching.

#include "tests/support/data.hpp"
#include "tests/support/middlebury.hpp"
#include <heel/cloud/setup_check.hpp>
#include <heel/cloud/stereo_matcher.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace heel {
namespace {

/// What cv::StereoSGBM with 5x5 blocks and usual parameters gets on each pair.
struct OpenCvFigures {
  double density, bad2_percent;
};
constexpr std::array<OpenCvFigures, 4> kOpenCv = {
    {{.87, 5.2}, {.90, 3.9}, {.87, 15.2}, {.88, 5.0}}};
constexpr double kOpenCvWorstMedian_mm = 8.4;

StereoMatcher matcherFor(const test::MiddleburyPair& pair) {
  StereoMatcherParams params;
  params.disparities = pair.disparities;
  return StereoMatcher(params);
}

TEST(RealStereoPairs, AreMatchedNoWorseThanByOpenCv) {
  HEEL_NEED_DATA("stereo_pairs");
  std::printf("%-11s density  bad2 %%  median depth error mm   (OpenCV's density, bad2)\n", "pair");
  for (std::size_t i = 0; i < test::kMiddleburyPairs.size(); ++i) {
    const char* name = test::kMiddleburyPairs[i];
    const auto pair = test::readMiddleburyPair(test::dataFolder() / "stereo_pairs" / name);
    cv::Mat disparity;
    matcherFor(pair).match(pair.left, pair.right, disparity);
    const test::MatchQuality q = test::matchQuality(disparity, pair);
    std::printf("%-11s %7.3f %7.2f %22.2f   (%.2f, %.1f)\n", name, q.density, q.bad2_percent,
                q.median_depth_error_mm, kOpenCv[i].density, kOpenCv[i].bad2_percent);
    EXPECT_GE(q.density, kOpenCv[i].density) << name;
    EXPECT_LE(q.bad2_percent, kOpenCv[i].bad2_percent) << name;
    EXPECT_LE(q.median_depth_error_mm, kOpenCvWorstMedian_mm) << name;
  }
}

TEST(RealStereoPairs, AreKnownToBeExchanged) {
  HEEL_NEED_DATA("stereo_pairs");
  for (const char* name : test::kMiddleburyPairs) {
    const auto pair = test::readMiddleburyPair(test::dataFolder() / "stereo_pairs" / name);
    StereoMatcher matcher = matcherFor(pair);
    EXPECT_FALSE(looksSwapped(pair.left, pair.right, matcher)) << name;
    EXPECT_TRUE(looksSwapped(pair.right, pair.left, matcher)) << name;
  }
}

/// A standing ellipse of `share` of the image.
cv::Mat1b standingEllipse(cv::Size size, double share, cv::Point centre) {
  cv::Mat1b mask(size, std::uint8_t{0});
  const double half_width = std::sqrt(share * size.area() / (CV_PI * 2.5));
  const cv::Size axes(cvRound(half_width), cvRound(2.5 * half_width));
  cv::ellipse(mask, centre, axes, 0.0, 0.0, 360.0, 255, cv::FILLED);
  return mask;
}

TEST(RealStereoPairs, AgreeWithDenseWhereMasked) {
  HEEL_NEED_DATA("stereo_pairs");
  std::printf("share  margin: within 1 px of dense, found of dense's (all pairs, four places)\n");
  for (const double share : {0.01, 0.05, 0.10, 0.25}) {
    test::Agreement sum;
    for (const char* name : test::kMiddleburyPairs) {
      const auto pair = test::readMiddleburyPair(test::dataFolder() / "stereo_pairs" / name);
      StereoMatcher matcher = matcherFor(pair);
      cv::Mat dense, masked;
      matcher.match(pair.left, pair.right, dense);
      const cv::Size size = pair.left.size();
      for (const double x : {0.2, 0.4, 0.6, 0.8}) {
        const cv::Mat1b mask =
            standingEllipse(size, share, {cvRound(x * size.width), size.height / 2});
        matcher.match(pair.left, pair.right, mask, masked);
        const test::Agreement a = test::agreement(masked, dense, mask, 1.0);
        sum.reference += a.reference;
        sum.both += a.both;
        sum.within += a.within;
      }
    }
    std::printf("%5.2f %6d: %.4f %.4f\n", share, StereoMatcherParams().margin_px, sum.withinShare(),
                sum.foundShare());
    EXPECT_GE(sum.withinShare(), 0.98) << share;
    EXPECT_GE(sum.foundShare(), 0.95) << share;
  }
}

}  // namespace
}  // namespace heel
