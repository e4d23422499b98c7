// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/stereo_scene.hpp"
#include <heel/cloud/masked_sgm.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <cstdint>
#include <stdexcept>
#include <type_traits>

namespace heel {
namespace {

using testing::HasSubstr;

struct Setting {
  int disparities, block_size, uniqueness_percent, left_right;
};

class MaskedSgmAndOpenCv : public testing::TestWithParam<Setting> {};

TEST_P(MaskedSgmAndOpenCv, AreEqualWhenEverythingIsWanted) {
  const Setting setting = GetParam();
  StereoMatcherParams params;
  params.disparities = setting.disparities;
  params.block_size = setting.block_size;
  params.uniqueness_percent = setting.uniqueness_percent;
  params.max_left_right_difference = setting.left_right;
  const test::StereoScene scene = test::render(test::roomWithPerson(), {400, 300}, 6.0);
  cv::Mat left, right, oracle, ours, filtered;
  cv::cvtColor(scene.left, left, cv::COLOR_BGR2GRAY);
  cv::cvtColor(scene.right, right, cv::COLOR_BGR2GRAY);

  cv::StereoSGBM::create(0, params.disparities, params.block_size, params.p1, params.p2,
                         params.max_left_right_difference, params.prefilter_cap,
                         params.uniqueness_percent, 0, 0, cv::StereoSGBM::MODE_SGBM)
      ->compute(left, right, oracle);

  cv::Mat1b wanted(left.size(), std::uint8_t{255});
  wanted.colRange(0, params.disparities) = 0;
  MaskedSgm(params).compute(left, right, wanted, ours);
  cv::medianBlur(ours, filtered, 3);  // cv::StereoSGBM's last step
  EXPECT_GT(cv::countNonZero(oracle >= 0), 0.5 * static_cast<double>(oracle.total()));
  EXPECT_EQ(cv::countNonZero(filtered != oracle), 0);
}

INSTANTIATE_TEST_SUITE_P(Settings, MaskedSgmAndOpenCv,
                         testing::Values(Setting{64, 5, 10, 1}, Setting{64, 3, 0, 1},
                                         Setting{32, 1, 5, 3}, Setting{128, 5, 15, 2},
                                         Setting{48, 5, 10, 1}));

TEST(MaskedSgm, GivesNothingOutsideOfTheMask) {
  const test::StereoScene scene = test::render(test::roomWithPerson(), {320, 240});
  cv::Mat left, right, disparity;
  cv::cvtColor(scene.left, left, cv::COLOR_BGR2GRAY);
  cv::cvtColor(scene.right, right, cv::COLOR_BGR2GRAY);
  cv::Mat1b wanted(left.size(), std::uint8_t{0});
  cv::ellipse(wanted, {200, 120}, {50, 90}, 20.0, 0.0, 360.0, 255, cv::FILLED);
  wanted(cv::Rect(80, 10, 3, 3)) = 1;
  wanted(cv::Rect(317, 236, 3, 4)) = 1;  // up to the corner
  MaskedSgm(StereoMatcherParams()).compute(left, right, wanted, disparity);
  EXPECT_EQ(cv::countNonZero((disparity >= 0) & (wanted == 0)), 0);
  EXPECT_GT(cv::countNonZero(disparity >= 0), cv::countNonZero(wanted) / 2);
}

TEST(MaskedSgm, RefusesWhatDoesNotFit) {
  MaskedSgm matcher{StereoMatcherParams()};
  cv::Mat out;
  const cv::Mat1b image(48, 100, std::uint8_t{9});
  cv::Mat1b wanted(48, 100, std::uint8_t{0});
  EXPECT_THROW(matcher.compute(image, image.rowRange(0, 40), wanted, out), std::invalid_argument);
  EXPECT_THROW(matcher.compute(image, image, wanted.colRange(0, 50), out), std::invalid_argument);
  EXPECT_THROW(matcher.compute(cv::Mat(48, 100, CV_8UC3), image, wanted, out),
               std::invalid_argument);
  wanted(10, 63) = 1;  // disparities up to 63 need 64 columns
  EXPECT_THROW(matcher.compute(image, image, wanted, out), std::invalid_argument);
}

TEST(MaskedSgm, RefusesParametersThatItsBuffersDoNotHold) {
  const auto expectRefused = [](int disparities, int block_size, const char* why) {
    StereoMatcherParams params;
    params.disparities = disparities;
    params.block_size = block_size;
    try {
      MaskedSgm matcher(params);
      ADD_FAILURE() << why;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  expectRefused(64, 7, "block_size must be 1, 3 or 5");
  expectRefused(272, 5, "disparities must be a multiple of 16, at most 256");
}

TEST(MaskedSgm, IsMovedButNotCopied) {
  EXPECT_TRUE(std::is_move_constructible_v<MaskedSgm>);
  EXPECT_FALSE(std::is_copy_constructible_v<MaskedSgm>);
  EXPECT_FALSE(std::is_copy_assignable_v<MaskedSgm>);
}

TEST(MaskedSgm, ForgetsThePreviousPair) {
  const auto grey = [](const cv::Mat& bgr) {
    cv::Mat image;
    cv::cvtColor(bgr, image, cv::COLOR_BGR2GRAY);
    return image;
  };
  const test::StereoScene one = test::render(test::roomWithPerson(), {320, 240});
  const test::StereoScene two = test::render({{{}, 20.0}}, {320, 240}, 2.0, 7);
  cv::Mat1b some(240, 320, std::uint8_t{0}), others(240, 320, std::uint8_t{0});
  some(cv::Rect(100, 50, 120, 100)) = 255;
  others(cv::Rect(150, 20, 60, 200)) = 255;
  cv::Mat fresh, reused;
  MaskedSgm(StereoMatcherParams()).compute(grey(two.left), grey(two.right), others, fresh);
  MaskedSgm matcher{StereoMatcherParams()};
  matcher.compute(grey(one.left), grey(one.right), some, reused);
  matcher.compute(grey(two.left), grey(two.right), others, reused);
  EXPECT_EQ(cv::countNonZero(fresh != reused), 0);
}

}  // namespace
}  // namespace heel
