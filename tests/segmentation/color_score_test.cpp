// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/painted_person.hpp"
#include <heel/segmentation/color_score.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using test::kBlack;
using test::kFloor;
using test::kNavy;
using test::kRed;
using test::kSkin;
using test::kWhite;
using test::paint;
using test::paintRoom;

double at(const ColorScore& score, Bgr c) { return score(c.b, c.g, c.r); }

TEST(PrincipalColorScore, IsThePapersFormulaForOneColour) {
  ColorHistogram person;  // half pure red, a quarter pure blue, a quarter black
  person.add({0, 0, 255}, 2);
  person.add({255, 0, 0}, 1);
  person.add({0, 0, 0}, 1);
  const auto score = principalColorScore(person);
  // The table's cell for 255 has its middle at 254: value bin 31 of 32, hues as before.
  EXPECT_NEAR(at(score, {0, 0, 255}), 0.75, 1e-12);      // s = 1: D_H(red); black counts as hue 0
  EXPECT_NEAR(at(score, {255, 0, 0}), 0.25, 1e-12);      // D_H(blue)
  EXPECT_NEAR(at(score, {0, 255, 0}), 0.0, 1e-12);       // no green
  EXPECT_NEAR(at(score, {0, 0, 0}), 0.25, 1e-12);        // s = 0: D_V(0)
  EXPECT_NEAR(at(score, {255, 255, 255}), 0.75, 1e-12);  // s = 0: D_V(1)
  EXPECT_NEAR(at(score, {128, 128, 255}), 0.75, 1e-12);  // half of each: red and D_V(1)
}

TEST(PrincipalColorScore, AgreesWithOpenCvsHueAndValue) {
  const ColorHistogram person = paint(kRed, 5000, 60.0);
  std::array<double, 36> hues{};
  std::array<double, 32> values{};
  cv::Mat3f pixel(1, 1);
  cv::Mat3f hsv;
  const auto convert = [&](Bgr c) {
    pixel(0, 0) = cv::Vec3f(c.b, c.g, c.r) / 255.0F;
    cv::cvtColor(pixel, hsv, cv::COLOR_BGR2HSV);
    return hsv(0, 0);
  };
  const auto hueBin = [](cv::Vec3f c) {
    return static_cast<std::size_t>(std::min(35, static_cast<int>(c[0] / 10.0F)));
  };
  const auto valueBin = [](cv::Vec3f c) {
    return static_cast<std::size_t>(std::min(31, static_cast<int>(c[2] * 32.0F)));
  };
  person.forEach([&](Bgr c, std::uint64_t count) {
    hues[hueBin(convert(c))] += static_cast<double>(count) / 5000.0;
    values[valueBin(convert(c))] += static_cast<double>(count) / 5000.0;
  });
  const auto score = principalColorScore(person);
  int off = 0;
  int colors = 0;
  person.forEach([&](Bgr c, std::uint64_t) {
    const cv::Vec3f h = convert(c);
    const double s = h[1];
    const double expected = s * hues[hueBin(h)] + (1.0 - s) * values[valueBin(h)];
    ++colors;
    // A hue on the very edge of a bin may be rounded into the next.
    if (std::abs(at(score, c) - expected) > 0.01) ++off;
  });
  EXPECT_GT(colors, 1000);
  EXPECT_LT(off, colors / 50);
}

TEST(PrincipalColorScore, OfSeveralColoursIsTheBestOne) {
  ColorHistogram stripes = paint(kRed, 2000, 2.0);
  stripes.merge(paint(kWhite, 2000, 2.0));
  PrincipalColorParams two;
  two.count = 2;
  const auto score = principalColorScore(stripes, two);
  const auto red = principalColorScore(paint(kRed, 2000, 2.0));
  const auto white = principalColorScore(paint(kWhite, 2000, 2.0));
  for (const Bgr c : {kRed, kWhite, kSkin, kNavy, kBlack, kFloor}) {
    EXPECT_DOUBLE_EQ(at(score, c), std::max(at(red, c), at(white, c)));
  }
}

TEST(PrincipalColorScore, RefusesParametersOutOfRange) {
  PrincipalColorParams params;
  params.hue_bins = 0;
  EXPECT_THROW(principalColorScore(paint(kRed, 9), params), std::invalid_argument);
  params = {};
  params.count = -1;
  EXPECT_THROW(principalColorScore(paint(kRed, 9), params), std::invalid_argument);
  EXPECT_THROW(principalColorScore(ColorHistogram()), std::invalid_argument);
}

TEST(ColorRatioScore, IsTheShareOfThePersonWithoutSmoothing) {
  ColorRatioParams params;
  params.smoothing_bins = 0.0;
  ColorHistogram person;
  person.add(kRed, 3);
  person.add(kWhite, 1);
  ColorHistogram room;
  room.add(kWhite, 1);
  room.add(kFloor, 1);
  const auto score = colorRatioScore(person, room, params);
  const double other = 1.0 / (36.0 * 36.0 * 32.0);
  EXPECT_NEAR(at(score, kRed), 0.75 / (0.75 + other), 1e-12);
  EXPECT_NEAR(at(score, kWhite), 0.25 / (0.25 + 0.5 + other), 1e-12);
  EXPECT_EQ(at(score, kFloor), 0.0);
  EXPECT_EQ(at(score, kSkin), 0.0);  // seen nowhere
}

TEST(ColorRatioScore, DiscountsTheColoursOfTheRoom) {
  ColorHistogram person = paint(kRed, 1000);
  person.merge(paint(kWhite, 1000));
  const auto score = colorRatioScore(person, paintRoom());
  EXPECT_GT(at(score, kRed), 0.95);
  EXPECT_LT(at(score, kWhite), 0.7);
  EXPECT_LT(at(score, kFloor), 0.05);
}

TEST(ColorRatioScore, TellsNavyFromBlack) {
  const auto score = colorRatioScore(paint(kNavy, 3000, 3.0), paintRoom());
  EXPECT_GT(at(score, kNavy), 0.95);
  EXPECT_LT(at(score, kBlack), 0.1);
}

TEST(ColorRatioScore, SmoothsToColoursNearby) {
  ColorHistogram person;
  person.add(kRed, 1);
  ColorHistogram room;
  room.add(kFloor, 1);
  const auto score = colorRatioScore(person, room);
  EXPECT_GT(at(score, {43, 33, 190}), 0.5);
  EXPECT_LT(at(score, {180, 30, 40}), 1e-6);
}

TEST(ColorRatioScore, RefusesParametersOutOfRange) {
  const auto person = paint(kRed, 9);
  EXPECT_THROW(colorRatioScore(ColorHistogram(), person), std::invalid_argument);
  EXPECT_THROW(colorRatioScore(person, ColorHistogram()), std::invalid_argument);
  ColorRatioParams params;
  params.dark_offset = 0.0;
  EXPECT_THROW(colorRatioScore(person, person, params), std::invalid_argument);
  params = {};
  params.smoothing_bins = -1.0;
  EXPECT_THROW(colorRatioScore(person, person, params), std::invalid_argument);
  params = {};
  params.chroma_bins = 0;
  EXPECT_THROW(colorRatioScore(person, person, params), std::invalid_argument);
}

TEST(HueSaturation, IsBlindToLightAndShade) {
  const auto score = hueSaturationScore(paint(kRed, 3000));
  EXPECT_GT(score(40, 30, 180), 0.05);
  EXPECT_NEAR(score(20, 15, 90), score(40, 30, 180), 0.05);
  EXPECT_LT(score(180, 30, 40), 1e-3);
}

TEST(HueSaturation, HuesGoRound) {
  HueSaturationParams params;
  params.hue_bins = 36;
  ColorHistogram purplish;
  purplish.add(10, 0, 200);  // A hue just under a full turn,
  const auto score = hueSaturationScore(purplish, params);
  EXPECT_GT(score(0, 10, 200), 0.0);  // and one just over 0.
}

TEST(HueSaturation, RejectsBadInput) {
  HueSaturationParams params;
  EXPECT_THROW(hueSaturationScore(ColorHistogram()), std::invalid_argument);
  params.hue_bins = 0;
  EXPECT_THROW(hueSaturationScore(paint(kRed, 9), params), std::invalid_argument);
}

}  // namespace
}  // namespace heel
