// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The floor of real rooms against the one that their sources give.

#include "tests/support/data.hpp"
#include <heel/cloud/ground_plane.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <pcl/io/pcd_io.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace heel {
namespace {

void report(const char* name, const GroundPlane& floor, const Mounting& truth) {
  const double degrees = 180.0 / CV_PI;
  std::printf(
      "%s: height %.3f m (%.3f), pitch %.2f deg (%.2f), roll %.2f deg (%.2f), "
      "inliers %.2f, spread %.3f m\n",
      name, floor.mounting.height_m, truth.height_m, degrees * floor.mounting.pitch_rad,
      degrees * truth.pitch_rad, degrees * floor.mounting.roll_rad, degrees * truth.roll_rad,
      floor.inlier_share, floor.rmsHeight(floor.plane));
}

void expectMounting(const Mounting& found, const Mounting& truth) {
  EXPECT_NEAR(found.height_m, truth.height_m, 0.05);
  EXPECT_NEAR(found.pitch_rad, truth.pitch_rad, 0.02);
  EXPECT_NEAR(found.roll_rad, truth.roll_rad, 0.02);
}

TEST(RealFloors, TheLabOfSixPeople) {
  HEEL_NEED_DATA("six_people");
  const auto folder = test::dataFolder() / "six_people";
  const YAML::Node yaml = YAML::LoadFile((folder / "camera.yaml").string());
  PinholeCamera camera;
  camera.fx = yaml["fx"].as<double>();
  camera.fy = yaml["fy"].as<double>();
  camera.cx = yaml["cx"].as<double>();
  camera.cy = yaml["cy"].as<double>();
  auto values = yaml["T_ground_camera"].as<std::array<double, 16>>();
  Eigen::Isometry3d T_ground_camera;
  T_ground_camera.matrix() =
      Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  const Mounting truth = mountingOf(T_ground_camera);

  GroundPlaneEstimator estimator;
  ColorCloud cloud;
  std::vector<cv::String> files;
  cv::glob((folder / "depth" / "*.png").string(), files);
  for (std::size_t i = 0; i < 10; ++i) {
    cv::Mat depth_m;
    cv::imread(files.at(i), cv::IMREAD_UNCHANGED).convertTo(depth_m, CV_32F, 1e-3);
    const cv::Mat image(depth_m.size(), CV_8UC3, cv::Scalar::all(0));
    makeColorCloud(depth_m, image, camera, Eigen::Isometry3d::Identity(), cloud);
    estimator.add(cloud);
  }
  const auto floor = estimator.estimate();
  ASSERT_TRUE(floor);
  report("six_people", *floor, truth);
  expectMounting(floor->mounting, truth);
  EXPECT_TRUE(floor->T_base_camera.isApprox(T_ground_camera, 0.05));
  EXPECT_EQ(mountingWarning(*floor, T_ground_camera), "");
}

TEST(RealFloors, TheHallOfFivePeople) {
  HEEL_NEED_DATA("clouds");
  ColorCloud cloud;
  ASSERT_EQ(
      pcl::io::loadPCDFile((test::dataFolder() / "clouds" / "five_people.pcd").string(), cloud), 0);
  // -0.0103586 x + 0.997011 y + 0.0765573 z - 1.26614 = 0, turned so that its normal is up.
  const Eigen::Vector3d up(0.0103586, -0.997011, -0.0765573);
  const Mounting truth{1.26614 / up.norm(), std::asin(-up.z() / up.norm()),
                       std::atan2(-up.x(), -up.y())};
  GroundPlaneEstimator estimator;
  estimator.add(cloud);
  const auto floor = estimator.estimate();
  ASSERT_TRUE(floor);
  report("five_people", *floor, truth);
  expectMounting(floor->mounting, truth);
}

}  // namespace
}  // namespace heel
