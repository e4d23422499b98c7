// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/painted_person.hpp"
#include <heel/segmentation/appearance_picture.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace heel {
namespace {

int countPixelsLike(const cv::Mat& picture, Bgr c, int tolerance) {
  const cv::Scalar color(c.b, c.g, c.r);
  cv::Mat found;
  cv::inRange(picture, color - cv::Scalar::all(tolerance), color + cv::Scalar::all(tolerance),
              found);
  return cv::countNonZero(found);
}

TEST(AppearancePicture, ShowsThePersonsColoursAndTheRooms) {
  const AppearanceModel model({}, test::paintPerson(), test::paintRoom());
  const cv::Mat picture = drawAppearance(model);
  ASSERT_EQ(picture.type(), CV_8UC3);
  constexpr int kPanel = 230 * 170;
  EXPECT_GT(countPixelsLike(picture, test::kRed, 12), kPanel * 8 / 10);
  EXPECT_GT(countPixelsLike(picture, test::kSkin, 12), kPanel * 6 / 10);
  EXPECT_GT(countPixelsLike(picture, test::kFloor, 12), kPanel * 8 / 10);  // a bit in both rows
}

TEST(AppearancePicture, HasARowForEachBandEvenIfItIsEmpty) {
  AppearanceParams paper;
  paper.bands = upperBody();
  const int one = drawAppearance({paper, {test::paint(test::kRed, 600)}, test::paintRoom()}).rows;
  const int two = drawAppearance({{}, {test::paint(test::kRed, 600), {}}, test::paintRoom()}).rows;
  EXPECT_GT(two, one + 170);
}

TEST(AppearancePicture, IsTheSameEachTime) {
  const AppearanceModel model({}, test::paintPerson(), test::paintRoom());
  EXPECT_EQ(cv::norm(drawAppearance(model), drawAppearance(model), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace heel
