// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Matching only where a mask says, against cv::StereoSGBM alone on the whole image: 640x480, one
/// thread.
///
/// Masks are like a colour filter's: a person, patches of the room, and lone specks.

#include "tests/benchmarks/against_dense.hpp"
#include "tests/support/middlebury.hpp"
#include "tests/support/stereo_scene.hpp"
#include <heel/cloud/color_cloud.hpp>
#include <heel/cloud/stereo_matcher.hpp>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdint>

namespace {

using namespace heel;

const test::StereoScene& scene() {
  static const test::StereoScene rendered = test::render(test::roomWithPerson());
  return rendered;
}

/// `percent` of the pixels: 70 % of them a person, 20 % in six patches, 10 % in specks.
cv::Mat1b colourMask(int percent) {
  const cv::Size size = scene().left.size();
  if (percent >= 100) return cv::Mat1b(size, std::uint8_t{255});
  cv::Mat1b mask(size, std::uint8_t{0});
  const double wanted = percent / 100.0 * size.area();
  const double half_width = std::sqrt(0.7 * wanted / (CV_PI * 2.2));
  cv::ellipse(mask, {320, 250}, {cvRound(half_width), cvRound(2.2 * half_width)}, 0.0, 0.0, 360.0,
              255, cv::FILLED);
  cv::RNG random(11);
  const int edge = cvRound(std::sqrt(0.2 * wanted / 6.0));
  for (int i = 0; i < 6; ++i) {
    mask(cv::Rect(random.uniform(0, size.width - edge), random.uniform(0, size.height - edge), edge,
                  edge)) = 255;
  }
  while (cv::countNonZero(mask) < wanted) {
    for (int i = 0; i < 20; ++i) {
      mask(random.uniform(0, size.height), random.uniform(0, size.width)) = 255;
    }
  }
  return mask;
}

/// Runs `step` and dense SGBM of the scene in turn.
template <typename Step>
void againstDense(benchmark::State& state, Step&& step) {
  test::againstDense(state, test::OpenCvMatcher(scene().left, scene().right), step);
}

void DenseMatcher(benchmark::State& state) {
  StereoMatcher matcher;
  cv::Mat disparity;
  againstDense(state, [&] { matcher.match(scene().left, scene().right, disparity); });
}
BENCHMARK(DenseMatcher)->UseManualTime()->Unit(benchmark::kMillisecond);

void MaskedMatcher(benchmark::State& state) {
  const cv::Mat1b mask = colourMask(static_cast<int>(state.range(0)));
  StereoMatcher matcher;
  cv::Mat dense, disparity;
  MaskedMatch count;
  againstDense(state, [&] { count = matcher.match(scene().left, scene().right, mask, disparity); });
  matcher.match(scene().left, scene().right, dense);
  const test::Agreement a = test::agreement(disparity, dense, mask, 1.0);
  state.counters["wanted"] = count.wanted;
  state.counters["specks"] = count.wanted - count.supported;
  state.counters["within_1px"] = a.withinShare();
}
BENCHMARK(MaskedMatcher)
    ->ArgName("percent")
    ->Arg(1)
    ->Arg(5)
    ->Arg(10)
    ->Arg(25)
    ->Arg(100)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Matching, depth and cloud of the masked pixels.
void MaskedStereoToCloud(benchmark::State& state) {
  const cv::Mat1b mask = colourMask(static_cast<int>(state.range(0)));
  const StereoCamera camera{{640, 480, 500.0, 500.0, 319.5, 239.5}, 0.12, 0.0};
  StereoMatcher matcher;
  MaskedCloud cloud;
  cv::Mat disparity, depth_m;
  againstDense(state, [&] {
    matcher.match(scene().left, scene().right, mask, disparity);
    disparityToDepth(disparity, camera, depth_m);
    cloud.update(depth_m, scene().left, mask, camera.left, Eigen::Isometry3d::Identity());
  });
}
BENCHMARK(MaskedStereoToCloud)
    ->ArgName("percent")
    ->Arg(10)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
