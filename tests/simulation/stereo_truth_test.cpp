// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/simulator.hpp"
#include "tests/simulation/scenes.hpp"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace heel {
namespace {

/// What OpenCV's matcher makes of a wall straight ahead.
struct WallStereo {
  double density = 0.0;     ///< Share of pixels with a disparity.
  double median_m = 0.0;    ///< Median of |depth - truth|, of those.
  double wrong = 0.0;       ///< Share of those more than two pixels off.
  double expected_m = 0.0;  ///< Depth error of half a pixel: Z^2 / (f b) / 2.
};

WallStereo lookAtWall(const std::string& material, double distance_m) {
  Scene scene = test::squareRoom();
  for (Wall& wall : scene.walls) wall.left = wall.right = {material, Rgb(0.6F, 0.6F, 0.6F)};
  scene.robot.start = {2.94 - distance_m, 0.0};
  scene.robot.camera.width = 640;
  scene.robot.camera.height = 200;
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
      ++pixels;
      const double d = disparity.at<short>(v, u) / 16.0, z = stereo.depth_m.at<float>(v, u);
      if (d <= 0.0) continue;
      errors.push_back(std::abs(fb / d - z));
      wrong += std::abs(d - fb / z) > 2.0;
    }
  }
  WallStereo result;
  result.density = static_cast<double>(errors.size()) / pixels;
  result.wrong = errors.empty() ? 0.0 : wrong / static_cast<double>(errors.size());
  if (!errors.empty()) {
    std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                     errors.end());
    result.median_m = errors[errors.size() / 2];
  }
  result.expected_m = distance_m * distance_m / fb / 2;
  return result;
}

TEST(StereoTruth, TexturedWallsGiveDenseDepthWithinTheStereoFormula) {
  for (const double distance_m : {1.5, 2.5, 4.5}) {
    for (const char* material : {"wallpaper", "brick", "carpet"}) {
      SCOPED_TRACE(std::string(material) + " at " + std::to_string(distance_m));
      const WallStereo seen = lookAtWall(material, distance_m);
      EXPECT_GT(seen.density, 0.9);
      EXPECT_LT(seen.wrong, 0.03);
      EXPECT_LT(seen.median_m, seen.expected_m);
      EXPECT_GT(seen.median_m, 0.0);
    }
  }
}

TEST(StereoTruth, BlankWallsFailAsRealOnesDo) {
  const WallStereo seen = lookAtWall("gloss", 2.5);
  EXPECT_LT(seen.density * (1.0 - seen.wrong), 0.6);
}

}  // namespace
}  // namespace heel
