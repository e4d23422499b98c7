// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_images.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <vector>

namespace heel {
namespace {

const StereoCamera kPair{{640, 480, 500.0, 500.0, 320.0, 240.0}, 0.1, 0.0};

/// A textured wall at the depth of this disparity, over the whole picture.
Frame wallAt(int disparity_px) {
  cv::Mat texture(120, 200, CV_8UC3), wide;
  cv::RNG random(7);
  random.fill(texture, cv::RNG::UNIFORM, 0, 256);
  cv::resize(texture, wide, {}, 4.0, 4.0, cv::INTER_CUBIC);
  Frame frame;
  frame.image_bgr = wide(cv::Rect(0, 0, 640, 480)).clone();
  frame.right_bgr = wide(cv::Rect(disparity_px, 0, 640, 480)).clone();
  return frame;
}

TEST(CoarseDepth, IsThatOfTheWholePictureWithinItsParts) {
  constexpr int kDisparity = 20;
  const cv::Rect left(100, 50, 60, 300), right(400, 0, 40, 480);
  CoarseDepth coarse(kPair);
  const cv::Mat& depth_m = coarse.of(wallAt(kDisparity), {left, right});
  ASSERT_EQ(depth_m.size(), cv::Size(640, 480));
  int found = 0;
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      const float z = depth_m.at<float>(y, x);
      if (!std::isfinite(z)) continue;
      ++found;
      EXPECT_NEAR(z, 500.0 * 0.1 / kDisparity, 0.15) << x << "," << y;
      // To the pixel of the small picture.
      const cv::Rect around(x - 2, y - 2, 5, 5);
      EXPECT_FALSE(((around & left) | (around & right)).empty()) << x << "," << y;
    }
  }
  EXPECT_GT(found, 0.9 * (left.area() + right.area()));
}

TEST(CoarseDepth, IsNoneWithoutPartsAfterAFrameThatHadSome) {
  CoarseDepth coarse(kPair);
  const auto pixels = [&](const std::vector<cv::Rect>& parts) {
    return cv::countNonZero(coarse.of(wallAt(20), parts) > 0.0F);
  };
  EXPECT_GT(pixels({cv::Rect(100, 50, 60, 300)}), 0);
  EXPECT_EQ(pixels({}), 0);
  EXPECT_EQ(pixels({cv::Rect()}), 0);
}

}  // namespace
}  // namespace heel
