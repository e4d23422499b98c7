// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/experiment/short_trial.hpp"
#include <heel/apps/experiment/light_experiment.hpp>
#include <heel/apps/simulation/color.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

double lightOf(const cv::Mat& image, int channel) {
  return toLinear(static_cast<float>(image.at<cv::Vec3b>(0, 0)[channel]) / 255.0F);
}

TEST(LightChange, ChangesLightByStopsAndRedAgainstBlue) {
  for (const LightChange& change : changesOfLight()) {
    Frame frame;
    frame.image_bgr = cv::Mat(2, 2, CV_8UC3, cv::Scalar(120, 130, 140));
    const cv::Mat before = frame.image_bgr;
    changeLight(frame, levelsAfter(change));
    const cv::Mat& after = frame.image_bgr;
    EXPECT_NEAR(lightOf(after, 1) / lightOf(before, 1), std::exp2(change.stops), 0.02);
    const double red = lightOf(after, 2) / lightOf(before, 2);
    const double blue = lightOf(after, 0) / lightOf(before, 0);
    EXPECT_NEAR(red / blue, 1.0 + change.red_against_blue, 0.02);
    EXPECT_TRUE(frame.right_bgr.empty());
    if (change.stops == 0.0 && change.red_against_blue == 0.0) {
      EXPECT_EQ(cv::norm(after, before), 0.0);
    }
  }
}

TEST(LightChange, WhiteStaysWhiteAndBlackBlack) {
  Frame frame;
  frame.image_bgr = cv::Mat(1, 1, CV_8UC3, cv::Scalar(255, 200, 0));
  frame.right_bgr = frame.image_bgr.clone();
  changeLight(frame, levelsAfter({1.0, 0.0}));
  EXPECT_EQ(frame.image_bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 255, 0));
  EXPECT_EQ(cv::norm(frame.image_bgr, frame.right_bgr), 0.0);
}

TEST(LightChange, NeedsAnImage) {
  Frame frame;
  EXPECT_THROW(changeLight(frame, levelsAfter({})), std::invalid_argument);
}

TEST(LightExperiment, WithoutAChangeItIsThePerceptionsOwn) {
  const PerceptionTruthParams params = test::shortTrial();
  const LightRun run = runLightExperiment(4, params);
  ASSERT_EQ(run.size(), 9U);
  const TargetMetrics own = runPerceptionTruthExperiment(4, params).target;
  EXPECT_EQ(run[4].right, own.right);
  EXPECT_EQ(run[4].frames_in_view, own.frames_in_view);
  LightRun sum;
  add(sum, run);
  add(sum, run);
  EXPECT_EQ(sum[4].right, 2 * run[4].right);
}

}  // namespace
}  // namespace heel
