// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/stereo_scene.hpp"
#include <heel/cloud/setup_check.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const cv::Mat& plainImage() {
  static const cv::Mat image(60, 80, CV_8UC3, cv::Scalar(120, 121, 122));
  return image;
}

/// Depths in the upper `share` of the image.
cv::Mat depths(double share) {
  cv::Mat depth(60, 80, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  depth.rowRange(0, cvRound(60 * share)) = 2.0;
  return depth;
}

TEST(SetupCheck, IsContentWithAGoodRecording) {
  SetupCheck check;
  for (int i = 0; i < 10; ++i) check.add(0.1 * i, plainImage(), depths(0.5));
  const SetupReport report = check.report();
  EXPECT_EQ(report.frames, 10U);
  EXPECT_DOUBLE_EQ(report.found_share, 0.5);
  EXPECT_NEAR(report.longest_step_s, 0.1, 1e-12);
  EXPECT_THAT(report.warnings, IsEmpty());
}

TEST(SetupCheck, SaysThatFewPixelsHaveADepth) {
  SetupCheck check;
  check.add(0.0, plainImage(), depths(0.1));
  check.add(0.1, plainImage(), depths(0.2));
  EXPECT_DOUBLE_EQ(check.report().found_share, 0.15);
  EXPECT_THAT(check.report().warnings, ElementsAre(HasSubstr("Only 15 % of the pixels")));
}

TEST(SetupCheck, SaysThatStampsRunBackwardsOrStall) {
  SetupCheck check;
  for (const double stamp : {0.0, 0.1, 0.05, 0.2, 0.2, 0.3, 2.8}) {
    check.add(stamp, plainImage(), cv::Mat());
  }
  const SetupReport report = check.report();
  EXPECT_EQ(report.backward_stamps, 1U);
  EXPECT_EQ(report.stalled_stamps, 1U);
  EXPECT_EQ(report.gaps, 1U);
  EXPECT_THAT(report.warnings,
              ElementsAre(HasSubstr("1 of 7 frames run backwards, first at frame 3"),
                          HasSubstr("equal the one before"), HasSubstr("at most 2500 ms")));
}

TEST(SetupCheck, SaysThatTheExposureIsClipped) {
  cv::Mat dark(60, 80, CV_8UC3, cv::Scalar(100, 101, 102));
  dark.rowRange(0, 30) = cv::Scalar::all(0);
  SetupCheck black;
  black.add(0.0, dark, cv::Mat());
  EXPECT_DOUBLE_EQ(black.report().black_share, 0.5);
  EXPECT_THAT(black.report().warnings,
              ElementsAre(HasSubstr("50 % of the pixels are quite black")));

  cv::Mat bright = plainImage().clone();
  bright.rowRange(0, 15) = cv::Scalar(200, 255, 255);
  SetupCheck white;
  white.add(0.0, bright, cv::Mat());
  EXPECT_DOUBLE_EQ(white.report().white_share, 0.25);
  EXPECT_THAT(white.report().warnings, ElementsAre(HasSubstr("25 % of the pixels are clipped")));
}

TEST(SetupCheck, SaysThatThePicturesAreGrey) {
  SetupCheck check;
  check.add(0.0, cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(100)), cv::Mat());
  EXPECT_THAT(check.report().warnings, ElementsAre(HasSubstr("The pictures are grey")));
  check.add(0.1, plainImage(), cv::Mat());
  EXPECT_THAT(check.report().warnings, IsEmpty());
}

TEST(SetupCheck, SaysThatLeftAndRightAreExchanged) {
  const test::StereoScene scene = test::render(test::roomWithPerson());
  StereoMatcher matcher;
  EXPECT_FALSE(looksSwapped(scene.left, scene.right, matcher));
  EXPECT_TRUE(looksSwapped(scene.right, scene.left, matcher));
  SetupCheck check;
  check.add(0.0, scene.right, cv::Mat());
  check.addPair(scene.right, scene.left, matcher);
  EXPECT_TRUE(check.report().swapped);
  EXPECT_THAT(check.report().warnings, Contains(HasSubstr("exchanged")));
}

TEST(SetupCheck, DoesNotCallABlankPairExchanged) {
  StereoMatcher matcher;
  EXPECT_FALSE(looksSwapped(plainImage(), plainImage(), matcher));
}

TEST(SetupCheck, SaysThatThereIsNoFrame) {
  EXPECT_THAT(SetupCheck().report().warnings, ElementsAre("There is no frame."));
}

TEST(SetupCheck, RefusesImagesThatDoNotFit) {
  SetupCheck check;
  EXPECT_THROW(check.add(0.0, cv::Mat(), cv::Mat()), std::invalid_argument);
  EXPECT_THROW(check.add(0.0, cv::Mat(60, 80, CV_8UC1), cv::Mat()), std::invalid_argument);
  EXPECT_THROW(check.add(0.0, plainImage(), cv::Mat(60, 81, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(check.add(0.0, plainImage(), cv::Mat(60, 80, CV_16UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace heel
