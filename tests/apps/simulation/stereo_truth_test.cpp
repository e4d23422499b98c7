// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace heel {
namespace {

/// What OpenCV's matcher makes of a wall straight ahead.
struct WallStereo {
  int pixels = 0;         ///< That were looked at.
  double density = 0.0;   ///< Share of pixels with a disparity.
  double median_m = 0.0;  ///< Median of |depth - truth|, of those.
  double spread_m = 0.0;  ///< Standard deviation of depth - truth, from the middle half.
  double wrong = 0.0;     ///< Share of those more than two pixels off.
  double pixel_m = 0.0;   ///< Depth error of one pixel: Z^2 / (f b).

  double right() const { return density * (1.0 - wrong); }
};

double quantile(std::vector<double>& values, double share) {
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

/// @param counts  Which pixels are judged, of the left image.
WallStereo lookAt(const Scene& scene, double distance_m,
                  const std::function<bool(const cv::Vec3b&)>& counts) {
  Simulator simulator(scene);
  const StereoReading& stereo = *simulator.step(0.0).stereo;
  const StereoCamera camera = simulator.camera();
  const auto sgbm = cv::StereoSGBM::create(0, 96, 5, 600, 2400, 1, 31, 10, 100, 2);
  cv::Mat disparity;
  sgbm->compute(stereo.left_bgr, stereo.right_bgr, disparity);
  const double fb = camera.left.fx * camera.baseline_m;
  std::vector<double> errors;
  int pixels = 0, wrong = 0;
  for (int v = 60; v < 140; ++v) {  // Away from floor and ceiling.
    for (int u = 120; u < 520; ++u) {
      if (!counts(stereo.left_bgr.at<cv::Vec3b>(v, u))) continue;
      ++pixels;
      const double d = disparity.at<short>(v, u) / 16.0, z = stereo.depth_m.at<float>(v, u);
      if (d <= 0.0 || std::abs(z - distance_m) > 0.15 * distance_m) continue;
      errors.push_back(fb / d - z);
      wrong += std::abs(d - fb / z) > 2.0;
    }
  }
  WallStereo result;
  result.pixels = pixels;
  result.pixel_m = distance_m * distance_m / fb;
  if (pixels == 0 || errors.empty()) return result;
  result.density = static_cast<double>(errors.size()) / pixels;
  result.wrong = wrong / static_cast<double>(errors.size());
  result.spread_m = (quantile(errors, 0.75) - quantile(errors, 0.25)) / 1.349;
  for (double& error : errors) error = std::abs(error);
  result.median_m = quantile(errors, 0.5);
  return result;
}

Scene roomWithWall(const std::string& material, double distance_m) {
  Scene scene = test::squareRoom();
  for (Wall& wall : scene.walls) wall.left = wall.right = {material, Rgb(0.6F, 0.6F, 0.6F)};
  scene.robot.start = {2.94 - distance_m, 0.0};
  scene.robot.camera.width = 640;
  scene.robot.camera.height = 200;
  return scene;
}

WallStereo lookAtWall(const std::string& material, double distance_m) {
  return lookAt(roomWithWall(material, distance_m), distance_m,
                [](const cv::Vec3b&) { return true; });
}

TEST(StereoTruth, TexturedWallsGiveDenseDepthWithinTheStereoFormula) {
  for (const double distance_m : {1.5, 2.5, 4.5}) {
    for (const char* material : {"wallpaper", "brick", "carpet"}) {
      SCOPED_TRACE(std::string(material) + " at " + std::to_string(distance_m));
      const WallStereo seen = lookAtWall(material, distance_m);
      EXPECT_GT(seen.density, 0.9);
      EXPECT_LT(seen.wrong, 0.03);
      EXPECT_LT(seen.median_m, 0.5 * seen.pixel_m);
      EXPECT_GT(seen.median_m, 0.0);
    }
  }
}

// sigma_Z = sigma_d Z^2 / (f b) with one sigma_d for all distances: an error of a constant number
// of pixels, whose spread in metres grows with the square of the distance.
TEST(StereoTruth, TheSpreadOfTheDepthErrorFollowsTheSquareOfTheDistance) {
  for (const char* material : {"roughcast", "brick"}) {
    SCOPED_TRACE(material);
    std::vector<double> sigma_px, log_z, log_spread;
    for (const double distance_m : {1.5, 2.1, 3.0, 4.2, 5.5}) {
      Scene scene = roomWithWall(material, distance_m);
      scene.robot.start_yaw_rad = 0.4;  // A slanted wall has all parts of a pixel as disparities.
      const WallStereo seen = lookAt(scene, distance_m, [](const cv::Vec3b&) { return true; });
      sigma_px.push_back(seen.spread_m / seen.pixel_m);
      log_z.push_back(std::log(distance_m));
      log_spread.push_back(std::log(seen.spread_m));
    }
    const auto mean = [](const std::vector<double>& values) {
      return std::accumulate(values.begin(), values.end(), 0.0) /
             static_cast<double>(values.size());
    };
    double along = 0.0, square = 0.0;
    for (std::size_t i = 0; i < log_z.size(); ++i) {
      along += (log_z[i] - mean(log_z)) * (log_spread[i] - mean(log_spread));
      square += (log_z[i] - mean(log_z)) * (log_z[i] - mean(log_z));
    }
    EXPECT_NEAR(along / square, 2.0, 0.25);
    for (const double sigma : sigma_px) EXPECT_NEAR(sigma / mean(sigma_px), 1.0, 0.25);
  }
}

// A lamp mirrored in a glossy wall burns the picture out: there is no texture left to match, and
// what there is (the highlight's rim) lies elsewhere for the other eye.
TEST(StereoTruth, GlareFailsAsRealGlareDoes) {
  Scene scene = roomWithWall("tiles", 2.5);
  scene.lights[0].at = {0.44, 0.0, 1.4};
  scene.lights[0].power *= 6.0;
  const auto burnt_out = [](const cv::Vec3b& c) { return std::min({c[0], c[1], c[2]}) >= 254; };
  const WallStereo glare = lookAt(scene, 2.5, burnt_out);
  const WallStereo beside = lookAt(scene, 2.5, [&](const auto& c) { return c[1] < 200; });
  EXPECT_GT(glare.pixels, 300);
  EXPECT_GT(beside.right(), 0.98);
  EXPECT_LT(glare.right(), 0.75);
}

TEST(StereoTruth, BlankWallsFailAsRealOnesDo) {
  const WallStereo seen = lookAtWall("gloss", 2.5);
  EXPECT_LT(seen.right(), 0.6);
}

}  // namespace
}  // namespace heel
