// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/depth_registration.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
const PinholeCamera kDepth{64, 48, 60.0, 60.0, 31.5, 23.5};
const PinholeCamera kColor{128, 96, 120.0, 120.0, 63.5, 47.5};

cv::Mat wall(double depth_m) {
  return {kDepth.height, kDepth.width, CV_32FC1, cv::Scalar(depth_m)};
}

TEST(DepthRegistration, OfTheSameCameraChangesNothing) {
  cv::Mat depth_m(kDepth.height, kDepth.width, CV_32FC1), registered_m;
  cv::randu(depth_m, 0.5, 6.0);
  depth_m.at<float>(3, 4) = kNone;
  DepthRegistration(kDepth, kDepth, Eigen::Isometry3d::Identity()).apply(depth_m, registered_m);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      if (v == 3 && u == 4) {
        EXPECT_TRUE(std::isnan(registered_m.at<float>(v, u)));
      } else {
        ASSERT_EQ(registered_m.at<float>(v, u), depth_m.at<float>(v, u)) << u << ", " << v;
      }
    }
  }
}

TEST(DepthRegistration, OfACoarserCameraLeavesNoHoles) {
  cv::Mat registered_m;
  DepthRegistration(kDepth, kColor, Eigen::Isometry3d::Identity()).apply(wall(2.0), registered_m);
  ASSERT_EQ(registered_m.size(), cv::Size(128, 96));
  EXPECT_EQ(cv::countNonZero(registered_m == 2.0F), 128 * 96);
}

TEST(DepthRegistration, ShiftsByTheBaselineAndKeepsWhatIsNearer) {
  // The depth camera is 0.1 m to the left of the colour camera: at 1 m, things are 6 px further to
  // the left in the colour image, at 3 m 2 px.
  const Eigen::Isometry3d T(Eigen::Translation3d(-0.1, 0.0, 0.0));
  cv::Mat depth_m = wall(3.0), registered_m;
  depth_m(cv::Rect(30, 20, 4, 4)).setTo(1.0);
  DepthRegistration(kDepth, kDepth, T).apply(depth_m, registered_m);
  EXPECT_EQ(registered_m.at<float>(21, 23), 3.0F);
  for (int u = 24; u < 28; ++u) EXPECT_EQ(registered_m.at<float>(21, u), 1.0F) << u;
  // What it hid from the depth camera has no depth, but for what is seen at its other side.
  EXPECT_EQ(registered_m.at<float>(21, 32), 3.0F);
  EXPECT_TRUE(std::isnan(registered_m.at<float>(21, 28)));
  EXPECT_TRUE(std::isnan(registered_m.at<float>(0, 63))) << "only the colour camera looks there";
}

TEST(DepthRegistration, TurnsWithTheCamera) {
  // The colour camera looks 0.1 rad further to the right: what is straight ahead of the depth
  // camera is to the left of its middle.
  const Eigen::Isometry3d T(Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitY()));
  cv::Mat depth_m = wall(std::numeric_limits<double>::quiet_NaN()), registered_m;
  depth_m.at<float>(24, 32) = 2.0F;
  DepthRegistration(kDepth, kDepth, T).apply(depth_m, registered_m);
  const auto u = static_cast<int>(std::lround(31.5 + 60.0 * std::tan(0.5 / 60.0 - 0.1)));
  EXPECT_NEAR(registered_m.at<float>(24, u), 2.0 * std::cos(0.1), 0.01);
}

TEST(DepthRegistration, OfFocalLengthsBeyondAllMeasureNothingIsLeft) {
  PinholeCamera depth = kDepth, color = kColor;
  depth.cx = 31.0;  // A ray straight ahead: 0 times infinity is no number.
  color.fx = 1e39;
  cv::Mat registered_m;
  DepthRegistration(depth, color, Eigen::Isometry3d::Identity()).apply(wall(2.0), registered_m);
  EXPECT_EQ(cv::countNonZero(registered_m == registered_m), 0);
}

TEST(DepthRegistration, RejectsWhatDoesNotFit) {
  EXPECT_THROW(DepthRegistration({}, kColor, Eigen::Isometry3d::Identity()), std::invalid_argument);
  const DepthRegistration registration(kDepth, kColor, Eigen::Isometry3d::Identity());
  cv::Mat registered_m;
  EXPECT_THROW(registration.apply(cv::Mat(4, 4, CV_32FC1), registered_m), std::invalid_argument);
}

TEST(DepthRegistration, TellsWhetherTwoCamerasSeeTheSame) {
  EXPECT_TRUE(seesTheSame(kDepth, kDepth));
  EXPECT_FALSE(seesTheSame(kDepth, kColor));
  PinholeCamera off = kDepth;
  off.cx += 0.4;
  EXPECT_TRUE(seesTheSame(kDepth, off));
  off.cx += 0.4;
  EXPECT_FALSE(seesTheSame(kDepth, off));
}

}  // namespace
}  // namespace heel
