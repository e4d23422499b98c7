// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/middlebury.hpp"
#include "tests/support/stereo_scene.hpp"
#include <heel/cloud/stereo_matcher.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace heel {
namespace {

using test::StereoScene;
using testing::HasSubstr;

const StereoScene& room() {
  static const StereoScene scene = test::render(test::roomWithPerson());
  return scene;
}

/// The person and, around it, `specks` lone pixels.
cv::Mat1b personMask(const StereoScene& scene, int specks = 0) {
  const cv::Mat person = scene.surface >= test::kPersonFirst;
  cv::Mat1b mask = person;
  cv::RNG random(5);
  for (int i = 0; i < specks; ++i)
    mask(random.uniform(0, mask.rows), random.uniform(0, mask.cols)) = 255;
  return mask;
}

TEST(StereoMatcher, FindsTheTruthOfARenderedRoom) {
  StereoMatcher matcher;
  cv::Mat disparity;
  const int found = matcher.match(room().left, room().right, disparity);
  ASSERT_EQ(disparity.type(), CV_32FC1);
  const test::Agreement a = test::agreement(disparity, room().disparity, room().seen_twice, 1.0);
  EXPECT_GT(a.foundShare(), 0.9);
  EXPECT_GT(a.withinShare(), 0.98);
  EXPECT_EQ(found, cv::countNonZero(disparity == disparity));
}

TEST(StereoMatcher, MatchesTheLeftBorderToo) {
  StereoMatcher matcher;
  cv::Mat disparity;
  matcher.match(room().left, room().right, disparity);
  cv::Mat1b strip(room().left.size(), std::uint8_t{0});
  strip.colRange(0, matcher.params().disparities) = 255;
  const cv::Mat seen = strip & room().seen_twice;
  const test::Agreement a = test::agreement(disparity, room().disparity, seen, 1.0);
  EXPECT_GT(a.foundShare(), 0.8);
  EXPECT_GT(a.withinShare(), 0.95);
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float d = disparity.at<float>(y, x);
      EXPECT_FALSE(d > static_cast<float>(x)) << "points beyond the right image";
    }
  }
}

TEST(StereoMatcher, MaskedAgreesWithDenseOnThePerson) {
  StereoMatcher matcher;
  cv::Mat dense, masked;
  matcher.match(room().left, room().right, dense);
  const cv::Mat1b mask = personMask(room(), 3000);
  const MaskedMatch result = matcher.match(room().left, room().right, mask, masked);
  EXPECT_EQ(result.wanted, cv::countNonZero(mask));
  EXPECT_GT(result.supported, 0.98 * cv::countNonZero(personMask(room())));
  EXPECT_LT(result.supported, result.wanted - 2000) << "specks are dropped";
  EXPECT_EQ(result.matched, cv::countNonZero(masked == masked));
  EXPECT_EQ(cv::countNonZero((masked == masked) & (mask == 0)), 0);
  const test::Agreement a = test::agreement(masked, dense, personMask(room()), 1.0);
  EXPECT_GT(a.foundShare(), 0.95);
  EXPECT_GT(a.withinShare(), 0.98);
}

TEST(StereoMatcher, MaskedIsDenseWhenEverythingIsWanted) {
  StereoMatcher matcher;
  cv::Mat dense, masked;
  const int found = matcher.match(room().left, room().right, dense);
  const cv::Mat1b all(room().left.size(), std::uint8_t{1});
  EXPECT_EQ(matcher.match(room().left, room().right, all, masked).matched, found);
  EXPECT_EQ(cv::countNonZero((dense != masked) & (dense == dense)), 0);
}

TEST(StereoMatcher, GivesNothingForAnEmptyMask) {
  StereoMatcher matcher;
  cv::Mat disparity;
  const cv::Mat1b none(room().left.size(), std::uint8_t{0});
  const MaskedMatch result = matcher.match(room().left, room().right, none, disparity);
  EXPECT_EQ(result.wanted, 0);
  EXPECT_EQ(result.matched, 0);
  EXPECT_EQ(cv::countNonZero(disparity == disparity), 0);
}

TEST(StereoMatcher, TakesGreyImages) {
  cv::Mat left, right, from_grey, from_colour;
  cv::cvtColor(room().left, left, cv::COLOR_BGR2GRAY);
  cv::cvtColor(room().right, right, cv::COLOR_BGR2GRAY);
  StereoMatcher matcher;
  EXPECT_EQ(matcher.match(left, right, from_grey),
            matcher.match(room().left, room().right, from_colour));
}

TEST(StereoMatcher, TakesImagesNarrowerThanItsRange) {
  const StereoScene scene = test::render({{{}, 6.0}}, {40, 40});
  StereoMatcher matcher;
  cv::Mat disparity;
  EXPECT_GT(matcher.match(scene.left, scene.right, disparity), 0);
  const cv::Mat1b all(40, 40, std::uint8_t{1});
  EXPECT_GT(matcher.match(scene.left, scene.right, all, disparity).matched, 0);
}

TEST(StereoMatcher, RefusesImagesThatDoNotFit) {
  StereoMatcher matcher;
  cv::Mat out;
  const cv::Mat image(48, 64, CV_8UC3, cv::Scalar::all(9));
  const auto message = [&](auto&& call) -> std::string {
    try {
      call();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(message([&] { matcher.match(cv::Mat(), image, out); }), HasSubstr("empty"));
  EXPECT_THAT(message([&] { matcher.match(image, image.colRange(0, 60), out); }),
              HasSubstr("differ in size"));
  EXPECT_THAT(message([&] { matcher.match(cv::Mat(48, 64, CV_16UC1), image, out); }),
              HasSubstr("8-bit"));
  EXPECT_THAT(message([&] { matcher.match(image, image, cv::Mat1b(48, 60), out); }),
              HasSubstr("mask"));
  EXPECT_THAT(message([&] { matcher.match(image, image, cv::Mat1f(48, 64), out); }),
              HasSubstr("mask"));
}

TEST(StereoMatcher, RefusesParametersOutOfRange) {
  const auto refused = [](auto&& change) {
    StereoMatcherParams params;
    change(params);
    EXPECT_THROW(StereoMatcher{params}, std::invalid_argument);
  };
  refused([](auto& p) { p.disparities = 50; });
  refused([](auto& p) { p.disparities = 272; });
  refused([](auto& p) { p.block_size = 4; });
  refused([](auto& p) { p.block_size = 7; });
  refused([](auto& p) { p.p1 = p.p2; });
  refused([](auto& p) { p.p2 = 901; });
  refused([](auto& p) { p.prefilter_cap = 64; });
  refused([](auto& p) { p.uniqueness_percent = 100; });
  refused([](auto& p) { p.max_left_right_difference = 0; });
  refused([](auto& p) { p.speckle_size = -1; });
  refused([](auto& p) { p.margin_px = -1; });
  refused([](auto& p) { p.min_support = 1.1; });
}

}  // namespace
}  // namespace heel
