// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/color_cloud.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace heel {
namespace {

ColorCloud cloudOf(const PinholeCamera& camera) {
  cv::Mat depth_m(camera.height, camera.width, CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      depth_m.at<float>(v, u) = (u + v) % 5 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                                 : 1.0F + 0.01F * static_cast<float>(u * v % 97);
    }
  }
  ColorCloud cloud;
  makeColorCloud(depth_m, cv::Mat::zeros(depth_m.size(), CV_8UC3), camera,
                 Eigen::Isometry3d::Identity(), cloud);
  return cloud;
}

TEST(FitPinhole, FindsTheCameraThatMadeTheCloud) {
  const auto camera = fitPinhole(cloudOf({64, 48, 52.5, 51.0, 31.5, 23.0}));
  ASSERT_TRUE(camera.has_value());
  EXPECT_EQ(camera->width, 64);
  EXPECT_EQ(camera->height, 48);
  EXPECT_NEAR(camera->fx, 52.5, 1e-3);
  EXPECT_NEAR(camera->fy, 51.0, 1e-3);
  EXPECT_NEAR(camera->cx, 31.5, 1e-3);
  EXPECT_NEAR(camera->cy, 23.0, 1e-3);
}

TEST(FitPinhole, RefusesAnUnorganizedCloud) {
  ColorCloud cloud = cloudOf({64, 48, 52.5, 51.0, 31.5, 23.0});
  cloud.width *= cloud.height;
  cloud.height = 1;
  EXPECT_FALSE(fitPinhole(cloud).has_value());
}

TEST(FitPinhole, RefusesPointsThatAreNotInTheirPixels) {
  ColorCloud cloud = cloudOf({64, 48, 52.5, 51.0, 31.5, 23.0});
  for (std::size_t i = 0; i < cloud.size(); i += 7) cloud[i].x += 0.3F;
  EXPECT_FALSE(fitPinhole(cloud).has_value());
}

TEST(FitPinhole, RefusesWhatDeterminesNoCamera) {
  const ColorCloud whole = cloudOf({64, 48, 52.5, 51.0, 31.5, 23.0});
  const auto only = [&](const auto& keeps) {
    ColorCloud cloud = whole;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!keeps(i % 64, i / 64)) cloud[i].z = std::numeric_limits<float>::quiet_NaN();
    }
    return fitPinhole(cloud);
  };
  using Index = std::size_t;
  EXPECT_FALSE(only([](Index u, Index v) { return u == v && (u == 11 || u == 32); })) << "2 points";
  EXPECT_FALSE(only([](Index u, Index) { return u == 20; })) << "one column";
  EXPECT_FALSE(only([](Index, Index v) { return v == 7; })) << "one row";
  EXPECT_TRUE(only([](Index u, Index v) { return u == v && u < 12; }));
}

TEST(FitPinhole, RefusesACloudWithoutPoints) {
  ColorCloud cloud = cloudOf({8, 4, 8, 8, 4, 2});
  for (auto& point : cloud) point.z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(fitPinhole(cloud).has_value());
}

}  // namespace
}  // namespace heel
