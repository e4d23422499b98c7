// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/color_cloud.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace heel {
namespace {

using testing::ElementsAre;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const PinholeCamera kCamera{3, 2, 100.0, 50.0, 1.0, 0.5};

cv::Mat1f depth() { return (cv::Mat1f(2, 3) << 2.0F, kNan, 4.0F, 0.0F, 1.0F, -1.0F); }

cv::Mat3b image() {
  cv::Mat3b bgr(2, 3);
  for (int i = 0; i < 6; ++i)
    bgr(i / 3, i % 3) = cv::Vec3b(1, 2, static_cast<std::uint8_t>(10 * i));
  return bgr;
}

Eigen::Isometry3d shifted() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << 10.0, 20.0, 30.0;
  return T;
}

void expectPoint(const pcl::PointXYZRGB& p, float x, float y, float z) {
  EXPECT_FLOAT_EQ(p.x, x);
  EXPECT_FLOAT_EQ(p.y, y);
  EXPECT_FLOAT_EQ(p.z, z);
}

TEST(ColorCloud, IsTheInverseProjectionInTheBaseFrame) {
  ColorCloud cloud;
  makeColorCloud(depth(), image(), kCamera, shifted(), cloud);
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.height, 2U);
  EXPECT_FALSE(cloud.is_dense);
  // x = (u - cx) z / fx, y = (v - cy) z / fy.
  expectPoint(cloud(0, 0), 10.0F - 0.02F, 20.0F - 0.02F, 32.0F);
  expectPoint(cloud(2, 0), 10.0F + 0.04F, 20.0F - 0.04F, 34.0F);
  expectPoint(cloud(1, 1), 10.0F, 20.0F + 0.01F, 31.0F);
  EXPECT_EQ(cloud(2, 0).r, 20);
  EXPECT_EQ(cloud(2, 0).g, 2);
  EXPECT_EQ(cloud(2, 0).b, 1);
  EXPECT_EQ(cloud(2, 0).a, 255);
}

TEST(ColorCloud, HasNoPositionButAColourWithoutDepth) {
  ColorCloud cloud;
  makeColorCloud(depth(), image(), kCamera, shifted(), cloud);
  for (const auto& p : {cloud(1, 0), cloud(0, 1), cloud(2, 1)}) {
    EXPECT_TRUE(std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z));
    EXPECT_EQ(p.g, 2);
  }
}

TEST(ColorCloud, HoldsOnlyMaskedPointsWithAMask) {
  const cv::Mat1b mask = (cv::Mat1b(2, 3) << 0, 1, 255, 1, 1, 0);
  ColorCloud cloud;
  pcl::Indices indices;
  makeColorCloud(depth(), image(), mask, kCamera, shifted(), cloud, indices);
  EXPECT_THAT(indices, ElementsAre(2, 4));
  EXPECT_EQ(cloud.size(), 6U);
  EXPECT_TRUE(std::isnan(cloud(0, 0).x));
  expectPoint(cloud(1, 1), 10.0F, 20.0F + 0.01F, 31.0F);
}

TEST(MaskedCloud, IsTheMaskedCloudOfEveryFrame) {
  cv::RNG random(2);
  MaskedCloud stream;
  ColorCloud once;
  pcl::Indices indices;
  for (const cv::Size size : {cv::Size(20, 10), cv::Size(20, 10), cv::Size(30, 8)}) {
    for (int frame = 0; frame < 4; ++frame) {
      cv::Mat1f z(size);
      cv::Mat3b bgr(size);
      cv::Mat1b mask(size);
      random.fill(z, cv::RNG::UNIFORM, -1.0, 4.0);
      random.fill(bgr, cv::RNG::UNIFORM, 0, 256);
      random.fill(mask, cv::RNG::UNIFORM, 0, 2);
      makeColorCloud(z, bgr, mask, kCamera, shifted(), once, indices);
      stream.update(z, bgr, mask, kCamera, shifted());
      ASSERT_EQ(stream.indices(), indices);
      ASSERT_EQ(stream.cloud()->size(), once.size());
      for (std::size_t i = 0; i < once.size(); ++i) {
        const auto& a = (*stream.cloud())[i];
        const auto& b = once[i];
        EXPECT_EQ(a.rgba, b.rgba);
        EXPECT_TRUE(std::isnan(b.x) ? std::isnan(a.x) : a.getVector3fMap() == b.getVector3fMap());
      }
    }
  }
}

TEST(MaskedCloud, IsMovedButNotCopied) {
  EXPECT_TRUE(std::is_move_constructible_v<MaskedCloud>);
  EXPECT_FALSE(std::is_copy_constructible_v<MaskedCloud>);
  EXPECT_FALSE(std::is_copy_assignable_v<MaskedCloud>);
}

TEST(ColorCloud, RefusesImagesThatDoNotFit) {
  ColorCloud cloud;
  pcl::Indices indices;
  const auto refused = [&](const cv::Mat& z, const cv::Mat& bgr, const PinholeCamera& camera) {
    EXPECT_THROW(makeColorCloud(z, bgr, camera, shifted(), cloud), std::invalid_argument);
  };
  refused(cv::Mat(2, 3, CV_16UC1), image(), kCamera);
  refused(depth(), cv::Mat(2, 3, CV_8UC1), kCamera);
  refused(depth(), cv::Mat(3, 2, CV_8UC3), kCamera);
  refused(depth(), image(), PinholeCamera{});
  EXPECT_THROW(
      makeColorCloud(depth(), image(), cv::Mat1b(3, 3), kCamera, shifted(), cloud, indices),
      std::invalid_argument);
  EXPECT_THROW(MaskedCloud().update(depth(), image(), cv::Mat1f(2, 3), kCamera, shifted()),
               std::invalid_argument);
}

TEST(DisparityToDepth, FollowsTheFormula) {
  const StereoCamera camera{{640, 480, 500.0, 500.0, 320.0, 240.0}, 0.1, 5.0};
  const cv::Mat1f disparity = (cv::Mat1f(1, 4) << 20.0F, 0.0F, kNan, -5.0F);
  cv::Mat depth_m;
  disparityToDepth(disparity, camera, depth_m);
  EXPECT_FLOAT_EQ(depth_m.at<float>(0), 2.0F);  // 500 * 0.1 / (20 + 5)
  EXPECT_FLOAT_EQ(depth_m.at<float>(1), 10.0F);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(2)));
  EXPECT_TRUE(std::isnan(depth_m.at<float>(3)));
}

TEST(DisparityToDepth, RefusesACameraWithoutBaseline) {
  StereoCamera camera{{640, 480, 500.0, 500.0, 320.0, 240.0}, 0.0, 0.0};
  cv::Mat depth_m;
  EXPECT_THROW(disparityToDepth(cv::Mat1f(2, 2), camera, depth_m), std::invalid_argument);
  camera.baseline_m = 0.1;
  EXPECT_THROW(disparityToDepth(cv::Mat(2, 2, CV_16SC1), camera, depth_m), std::invalid_argument);
}

}  // namespace
}  // namespace heel
