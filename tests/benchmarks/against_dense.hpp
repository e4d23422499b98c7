// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Work against cv::StereoSGBM alone on the whole image. Each iteration runs both, so that the
/// ratio does not depend on the machine's mood.
#pragma once

#include <heel/cloud/stereo_params.hpp>

#include <benchmark/benchmark.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <ctime>

namespace heel::test {

/// Time that this thread has had on a core.
inline double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Dense matching as a user of OpenCV runs it: grey images, the parameters of ours.
class OpenCvMatcher {
 public:
  OpenCvMatcher(const cv::Mat& left_bgr, const cv::Mat& right_bgr,
                const StereoMatcherParams& p = {})
      : matcher_(cv::StereoSGBM::create(
            0, p.disparities, p.block_size, p.p1, p.p2, p.max_left_right_difference,
            p.prefilter_cap, p.uniqueness_percent, p.speckle_size, 1, cv::StereoSGBM::MODE_SGBM)) {
    cv::cvtColor(left_bgr, left_, cv::COLOR_BGR2GRAY);
    cv::cvtColor(right_bgr, right_, cv::COLOR_BGR2GRAY);
  }

  double run_s() {
    const double start = cpuSeconds();
    matcher_->compute(left_, right_, disparity_);
    return cpuSeconds() - start;
  }

 private:
  cv::Ptr<cv::StereoSGBM> matcher_;
  cv::Mat left_, right_, disparity_;
};

/// Runs `step` and dense SGBM in turn; reports the step's time and its share of the other's.
template <typename Step>
void againstDense(benchmark::State& state, OpenCvMatcher dense, Step&& step) {
  cv::setNumThreads(1);
  double ours_s = 0.0, dense_s = 0.0;
  step();  // warm
  dense.run_s();
  for (auto _ : state) {
    dense_s += dense.run_s();
    const double start = cpuSeconds();
    step();
    const double taken = cpuSeconds() - start;
    ours_s += taken;
    state.SetIterationTime(taken);
  }
  state.counters["dense_ms"] = 1e3 * dense_s / static_cast<double>(state.iterations());
  state.counters["of_dense"] = ours_s / dense_s;
}

}  // namespace heel::test
