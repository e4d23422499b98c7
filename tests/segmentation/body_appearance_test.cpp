// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

AppearanceBand bandOf(double min_m, double max_m, std::uint8_t red_over) {
  return {min_m, max_m, ColorTable([=](std::uint8_t, std::uint8_t, std::uint8_t r) {
            return static_cast<std::uint8_t>(r > red_over ? 255 : 0);
          })};
}

pcl::PointXYZRGB point(float x, float y, float z, std::uint8_t red) {
  pcl::PointXYZRGB p;
  p.x = x;
  p.y = y;
  p.z = z;
  p.r = red;
  p.g = p.b = 0;
  return p;
}

BodyAppearanceParams withoutPrior() {
  BodyAppearanceParams params;
  params.prior_points = 0.0;
  return params;
}

TEST(BodyAppearance, IsTheShareOfTheBodysPointsThatPass) {
  ColorCloud cloud;
  for (int i = 0; i < 3; ++i) cloud.push_back(point(2, 0, 1.5, 255));
  cloud.push_back(point(2, 0, 1.5, 0));
  cloud.push_back(point(2.5, 0, 1.5, 0));  // beside the body
  cloud.push_back(point(2, 0, 0.5, 0));    // under the band
  cloud.push_back(point(kNaN, kNaN, kNaN, 0));
  EXPECT_DOUBLE_EQ(bodyAppearance(cloud, {2, 0}, {bandOf(1, 2, 100)}, withoutPrior()), 0.75);
}

TEST(BodyAppearance, IsTheGeometricMeanOverTheBands) {
  ColorCloud cloud;
  for (int i = 0; i < 4; ++i) cloud.push_back(point(2, 0, 1.5, 255));
  for (int i = 0; i < 4; ++i) cloud.push_back(point(2, 0, 0.5, i == 0 ? 255 : 0));
  const AppearanceBands bands = {bandOf(1, 2, 100), bandOf(0.25, 0.9, 100)};
  EXPECT_NEAR(bodyAppearance(cloud, {2, 0}, bands, withoutPrior()), std::sqrt(1.0 * 0.25), 1e-12);
}

TEST(BodyAppearance, SaysNothingEitherWayWithoutEvidence) {
  EXPECT_DOUBLE_EQ(bodyAppearance(ColorCloud(), {2, 0}, {bandOf(1, 2, 100)}), 0.5);
}

// A level camera 1.5 m up looks along x at an upright red board 0.4 m wide, 2 m away.
BodyView viewOfABoard(float depth_m) {
  BodyView view;
  view.camera = {160, 120, 100, 100, 79.5, 59.5};
  view.T_base_camera = Eigen::Isometry3d::Identity();
  view.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  view.T_base_camera.translation() = Eigen::Vector3d(0, 0, 1.5);
  view.image_bgr = cv::Mat(120, 160, CV_8UC3, cv::Scalar(0, 0, 0));
  view.depth_m = cv::Mat(120, 160, CV_32FC1, cv::Scalar(kNaN));
  const cv::Rect board(70, 0, 20, 120);
  view.image_bgr(board).setTo(cv::Scalar(0, 0, 255));
  view.depth_m(board).setTo(depth_m);
  return view;
}

TEST(BodyAppearance, OfAnImageCountsThePixelsInTheCylinder) {
  BodyAppearanceParams params = withoutPrior();
  params.board_half_width_m = 0.0001;
  EXPECT_DOUBLE_EQ(bodyAppearance(viewOfABoard(2.0F), {2, 0}, {bandOf(1, 2, 100)}, params), 1.0);
}

TEST(BodyAppearance, OfAnImageLeavesOutWhatIsBehindTheBody) {
  BodyAppearanceParams params;
  params.board_half_width_m = 0.0001;
  // All red pixels are known to be 2 m behind: what is left is the prior.
  EXPECT_NEAR(bodyAppearance(viewOfABoard(4.0F), {2, 0}, {bandOf(1, 2, 100)}, params), 0.5, 0.05);
}

TEST(BodyAppearance, OfAnImageWithoutDepthCountsTheBoard) {
  BodyAppearanceParams params = withoutPrior();
  params.board_half_width_m = 0.4;  // twice as wide as the red board
  EXPECT_NEAR(bodyAppearance(viewOfABoard(kNaN), {2, 0}, {bandOf(1, 2, 100)}, params), 0.5, 0.05);
  params.board_half_width_m = 0.15;
  EXPECT_NEAR(bodyAppearance(viewOfABoard(kNaN), {2, 0}, {bandOf(1, 2, 100)}, params), 1.0, 0.1);
}

TEST(BodyAppearance, OfABodyBehindTheCameraSaysNothing) {
  EXPECT_DOUBLE_EQ(bodyAppearance(viewOfABoard(2.0F), {-2, 0}, {bandOf(1, 2, 100)}), 0.5);
}

TEST(AnyBand, PassesWhatOneOfTheBandsPasses) {
  const ColorTable table = anyBand({bandOf(1, 2, 200), bandOf(0, 1, 100)});
  EXPECT_TRUE(table.passes(0, 0, 150));
  EXPECT_FALSE(table.passes(0, 0, 50));
  EXPECT_THROW(anyBand({}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
