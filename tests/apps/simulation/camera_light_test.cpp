// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/simulation/scenes.hpp"
#include <heel/apps/simulation/camera_light.hpp>
#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <set>

namespace heel {
namespace {

constexpr std::uint64_t kSeeds = 50;

/// A camera without noise, vignetting and blur, whose signal is the radiance.
CameraParams plainCamera() {
  CameraParams camera;
  camera.width = 64;
  camera.height = 48;
  camera.exposure = 1.0;
  camera.read_noise = camera.shot_noise = camera.vignetting = camera.blur_px = 0.0;
  return camera;
}

cv::Mat grey(float radiance) { return {48, 64, CV_32FC3, cv::Scalar::all(radiance)}; }

cv::Mat developed(cv::Mat radiance, const CameraLight& light, double gamma = 1.0) {
  cv::Mat bgr;
  CameraModel(plainCamera(), 1, gamma).develop(radiance, 1, 1.0F, light, bgr);
  return bgr;
}

TEST(CameraLight, GivesGreyTheGainsAndTheGamma) {
  CameraLight light;
  light.exposure = 1.5;
  light.gains = {0.8F, 1.0F, 1.25F};
  const cv::Mat bgr = developed(grey(0.2F), light, 1.2);
  for (int c = 0; c < 3; ++c) {
    const float display = toDisplay(0.3F * light.gains[static_cast<std::size_t>(c)]);
    const double expected = 255.0 * std::pow(display, 1.2);
    for (int v = 0; v < bgr.rows; v += 7) EXPECT_NEAR(bgr.at<cv::Vec3b>(v, 5)[c], expected, 0.6);
  }
}

TEST(CameraLight, ATurnWidensAnEdgeByItsPixels) {
  for (const double way_px : {0.5, 2.0, 5.5, 11.0}) {
    cv::Mat radiance = grey(0.1F);
    radiance.colRange(32, 64).setTo(cv::Scalar::all(0.5));
    CameraLight light;
    light.blur_px = way_px;
    const cv::Mat bgr = developed(radiance, light);
    for (int u = 0; u < 64;
         ++u) {  // The edge is at 31.5; a pixel that does not move sees one side.
      const double share = std::clamp(0.5 + (u - 31.5) / std::max(way_px, 1.0), 0.0, 1.0);
      const double expected = 255.0 * toDisplay(static_cast<float>(0.1 + 0.4 * share));
      EXPECT_NEAR(bgr.at<cv::Vec3b>(20, u)[1], expected, 0.6) << u << ", " << way_px;
    }
  }
}

TEST(CameraLight, FlickerIsInRowsAndAsWideAsSaid) {
  CameraLight light;
  light.flicker = 0.1;
  light.flicker_bands = 3.0;
  light.flicker_phase = 0.7;
  const cv::Mat bgr = developed(grey(0.3F), light);
  for (int v = 0; v < bgr.rows; ++v) {
    const double share = 1.0 + 0.1 * std::sin(2.0 * M_PI * 3.0 * v / bgr.rows + 0.7);
    const double expected = 255.0 * toDisplay(static_cast<float>(0.3 * share));
    for (const int u : {0, 40, 63}) EXPECT_NEAR(bgr.at<cv::Vec3b>(v, u)[0], expected, 0.6);
  }
}

TEST(DrawnLight, ExposureGoesToItsAimWithItsLag) {
  constexpr double kLag_s = 0.5;
  DrawnLight light(3);
  EXPECT_NEAR(light.at(0.0, grey(0.1F), 2.0, 0.0).exposure, 0.18 / 0.2, 1e-6)
      << "it was there before the first picture";
  // Somebody turns the light up by a stop: half of it, in stops, is left after lag * ln 2.
  double at_s = 0.0;
  double exposure = 0.0;
  for (int i = 1; i <= 10; ++i) {
    at_s = 0.1 * i * kLag_s * std::log(2.0);
    exposure = light.at(at_s, grey(0.2F), 2.0, 0.0).exposure;
  }
  EXPECT_NEAR(exposure, 0.18 / 0.4 * std::sqrt(2.0), 1e-6);
  exposure = light.at(at_s + 20.0 * kLag_s, grey(0.2F), 2.0, 0.0).exposure;
  EXPECT_NEAR(exposure, 0.18 / 0.4, 1e-6);
}

TEST(DrawnLight, ExposureBearsWhiteAndBlack) {
  DrawnLight light(3);
  EXPECT_EQ(light.at(0.0, grey(0.0F), 2.0, 0.0).exposure, 4.0);
  double exposure = 0.0;
  for (int i = 1; i <= 5; ++i) exposure = light.at(60.0 * i, grey(1e6F), 2.0, 0.0).exposure;
  EXPECT_EQ(exposure, 0.25);
}

TEST(DrawnLight, BalanceWandersWithinItsRange) {
  std::set<double> gammas;
  double lowest = 1.0, highest = 1.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    DrawnLight light(seed);
    gammas.insert(light.gamma());
    EXPECT_GE(light.gamma(), 0.8);
    EXPECT_LE(light.gamma(), 1.25);
    std::array<float, 3> last = light.at(0.0, grey(0.1F), 2.0, 0.0).gains;
    const std::array<float, 3> first = last;
    for (double stamp_s = 0.1; stamp_s < 120.0; stamp_s += 0.1) {
      const std::array<float, 3> gains = light.at(stamp_s, grey(0.1F), 2.0, 0.0).gains;
      EXPECT_EQ(gains[1], 1.0F);
      for (const std::size_t c : {0U, 2U}) {
        ASSERT_GE(gains[c], 1.0F / 1.3F - 1e-6F);
        ASSERT_LE(gains[c], 1.3F + 1e-6F);
        ASSERT_NEAR(gains[c], last[c], 0.006) << "slowly";
        lowest = std::min<double>(lowest, gains[c]);
        highest = std::max<double>(highest, gains[c]);
      }
      last = gains;
    }
    EXPECT_NE(first, last);
  }
  EXPECT_EQ(gammas.size(), kSeeds);
  EXPECT_LT(lowest, 0.8);
  EXPECT_GT(highest, 1.25);
}

TEST(DrawnLight, BlursWhatTurnsWhileTheShutterIsOpen) {
  DrawnLight light(1);
  EXPECT_DOUBLE_EQ(light.at(0.0, grey(0.1F), 2.0, -150.0).blur_px, 150.0 * 0.02);
}

/// Two seconds of a robot that turns.
std::vector<cv::Mat> pictures(bool drawn, std::uint64_t seed, int threads = 0) {
  Scene scene = test::squareRoom();
  scene.people.push_back(test::standingPerson("eva", 2.0, 0.3));
  scene.robot.camera.drawn_light = drawn;
  Simulator simulator(scene, {seed, threads, true});
  std::vector<cv::Mat> result;
  for (int i = 0; i < 20; ++i) {
    const StereoReading& stereo = *simulator.step(i == 0 ? 0.0 : 0.1, {0.0, 0.8}).stereo;
    for (const cv::Mat* picture : {&stereo.left_bgr, &stereo.right_bgr, &stereo.depth_m}) {
      result.push_back(picture->clone());
    }
  }
  return result;
}

double difference(const std::vector<cv::Mat>& a, const std::vector<cv::Mat>& b, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < a.size(); i += 3) sum += cv::norm(a[i], b[i], cv::NORM_L1);
  return sum;
}

TEST(DrawnLight, IsTheSameForTheSameSeedAndNoOther) {
  const auto one = pictures(true, 7, 1), same = pictures(true, 7, 4);
  for (const std::size_t picture : {0U, 1U}) EXPECT_EQ(difference(one, same, picture), 0.0);
  const auto other = pictures(true, 8), fixed = pictures(false, 7);
  const double bytes = 20.0 * 160 * 120 * 3;
  EXPECT_GT(difference(one, other, 0), 4.0 * bytes);
  EXPECT_GT(difference(one, fixed, 0), 4.0 * bytes);
  EXPECT_EQ(difference(one, fixed, 2), 0.0) << "the world is the same";
}

TEST(DrawnLight, IsTheSameForBothCameras) {
  const auto drawn = pictures(true, 7), fixed = pictures(false, 7);
  for (std::size_t i = 0; i < drawn.size(); i += 3) {
    const cv::Scalar left = cv::mean(drawn[i]) - cv::mean(fixed[i]);
    const cv::Scalar right = cv::mean(drawn[i + 1]) - cv::mean(fixed[i + 1]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(left[c], right[c], 2.0);
  }
}

}  // namespace
}  // namespace heel
