// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

AppearanceBand bandOf(double min_m, double max_m, std::uint8_t red_over) {
  AppearanceBand band;
  band.body = {"band", min_m, max_m};
  band.table = ColorTable([=](std::uint8_t, std::uint8_t, std::uint8_t r) {
    return static_cast<std::uint8_t>(r > red_over ? 255 : 0);
  });
  return band;
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

WorldBlob at(double x_m, double height_m = 1.8) {
  WorldBlob blob;
  blob.position_m = {x_m, 0.0};
  blob.max_height_m = height_m;
  return blob;
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
  EXPECT_DOUBLE_EQ(bodyAppearance(cloud, at(2), {bandOf(1, 2, 100)}, withoutPrior()), 0.75);
}

TEST(BodyAppearance, IsTheGeometricMeanOverTheBands) {
  ColorCloud cloud;
  for (int i = 0; i < 4; ++i) cloud.push_back(point(2, 0, 1.5, 255));
  for (int i = 0; i < 4; ++i) cloud.push_back(point(2, 0, 0.5, i == 0 ? 255 : 0));
  const std::vector<AppearanceBand> bands = {bandOf(1, 2, 100), bandOf(0.25, 0.9, 100)};
  EXPECT_NEAR(bodyAppearance(cloud, at(2), bands, withoutPrior()), std::sqrt(1.0 * 0.25), 1e-12);
}

TEST(BodyAppearance, SaysNothingEitherWayWithoutEvidence) {
  EXPECT_DOUBLE_EQ(bodyAppearance(ColorCloud(), at(2), {bandOf(1, 2, 100)}), 0.5);
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
  EXPECT_DOUBLE_EQ(bodyAppearance(viewOfABoard(2.0F), at(2), {bandOf(1, 2, 100)}, params), 1.0);
}

TEST(BodyAppearance, OfAnImageLeavesOutWhatIsBehindTheBody) {
  BodyAppearanceParams params;
  params.board_half_width_m = 0.0001;
  // All red pixels are known to be 2 m behind: what is left is the prior.
  EXPECT_NEAR(bodyAppearance(viewOfABoard(4.0F), at(2), {bandOf(1, 2, 100)}, params), 0.5, 0.05);
}

TEST(BodyAppearance, OfAnImageWithoutDepthCountsTheBoard) {
  BodyAppearanceParams params = withoutPrior();
  params.board_half_width_m = 0.4;  // twice as wide as the red board
  EXPECT_NEAR(bodyAppearance(viewOfABoard(kNaN), at(2), {bandOf(1, 2, 100)}, params), 0.5, 0.05);
  params.board_half_width_m = 0.15;
  EXPECT_NEAR(bodyAppearance(viewOfABoard(kNaN), at(2), {bandOf(1, 2, 100)}, params), 1.0, 0.1);
}

TEST(BodyAppearance, OfAnImageWithoutDepthEndsAtTheBlobsHeight) {
  BodyAppearanceParams params = withoutPrior();
  params.board_half_width_m = 0.15;
  params.least_height_m = 1.5;
  BodyView view = viewOfABoard(kNaN);
  view.image_bgr.rowRange(0, 52).setTo(cv::Scalar(0, 0, 0));  // all that is above 1.65 m
  const std::vector<AppearanceBand> bands = {bandOf(1, 2, 100)};
  EXPECT_NEAR(bodyAppearance(view, at(2, 1.65), bands, params), 1.0, 0.1);
  EXPECT_NEAR(bodyAppearance(view, at(2, 2.0), bands, params), 0.65, 0.05);
}

TEST(BodyAppearance, OfABodyBehindTheCameraSaysNothing) {
  EXPECT_DOUBLE_EQ(bodyAppearance(viewOfABoard(2.0F), at(-2), {bandOf(1, 2, 100)}), 0.5);
}

TEST(BodyAppearance, LeavesOutABandOfWhichNothingWasLearned) {
  ColorCloud cloud;
  cloud.push_back(point(2, 0, 1.5, 255));
  AppearanceBand nothing;
  nothing.body = {"legs", 0.25, 0.9};
  EXPECT_DOUBLE_EQ(bodyAppearance(cloud, at(2), {bandOf(1, 2, 100), nothing}, withoutPrior()), 1);
}

}  // namespace
}  // namespace heel
