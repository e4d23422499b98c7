// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/person_outline.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace heel {
namespace {

const Eigen::Vector2d kPlace_m(4.0, 0.3);

/// A grey wall, seen along X from a height of 1 m.
class PersonOutlineTest : public testing::Test {
 protected:
  PersonOutlineTest() {
    view_.camera = PinholeCamera{640, 480, 500.0, 500.0, 319.5, 239.5};
    view_.image_bgr = cv::Mat(480, 640, CV_8UC3, cv::Scalar(150, 150, 150));
    view_.T_base_camera.setIdentity();
    view_.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    view_.T_base_camera.translation() = Eigen::Vector3d(0.0, 0.0, 1.0);
  }

  /// Where something at kPlace_m is in the picture, so far to the left and so high.
  cv::Point at(double left_m, double height_m) const {
    return {static_cast<int>(std::lround(319.5 - 500.0 * (kPlace_m.y() + left_m) / kPlace_m.x())),
            static_cast<int>(std::lround(239.5 + 500.0 * (1.0 - height_m) / kPlace_m.x()))};
  }
  void limb(double left_a_m, double a_m, double left_b_m, double b_m, double width_m,
            const cv::Scalar& bgr) {
    cv::line(view_.image_bgr, at(left_a_m, a_m), at(left_b_m, b_m), bgr,
             static_cast<int>(500.0 * width_m / kPlace_m.x()), cv::LINE_AA);
  }
  void drawPerson() {
    const cv::Scalar trousers(60, 40, 40), top(40, 40, 90), skin(130, 160, 200);
    limb(0.1, 0.1, 0.08, 0.8, 0.14, trousers);
    limb(-0.1, 0.1, -0.08, 0.8, 0.14, trousers);
    limb(0.0, 0.95, 0.0, 1.3, 0.3, top);
    limb(0.22, 0.85, 0.18, 1.35, 0.09, top);
    limb(-0.22, 0.85, -0.18, 1.35, 0.09, top);
    limb(0.0, 1.6, 0.0, 1.66, 0.16, skin);
  }

  BodyView view_;
  PersonOutline outline_;
};

TEST_F(PersonOutlineTest, SaysThatAFigureIsAPerson) {
  drawPerson();
  EXPECT_GT(outline_.logPerson(view_, kPlace_m), 0.5);
}

TEST_F(PersonOutlineTest, SaysThatAWallIsNone) {
  EXPECT_LT(outline_.logPerson(view_, kPlace_m), -0.5);
}

TEST_F(PersonOutlineTest, SaysThatACupboardIsNone) {
  cv::rectangle(view_.image_bgr, at(0.4, 1.8), at(-0.4, 0.0), {50, 70, 90}, cv::FILLED);
  EXPECT_LT(outline_.logPerson(view_, kPlace_m), -0.5);
}

TEST_F(PersonOutlineTest, LooksAtThePlaceOnly) {
  drawPerson();
  EXPECT_LT(outline_.logPerson(view_, {4.0, 1.3}), -0.5);
}

TEST_F(PersonOutlineTest, SaysNothingOfWhoIsOutOfThePicture) {
  EXPECT_FALSE(outline_.classify(view_, {4.0, 3.0}));
  EXPECT_FALSE(outline_.classify(view_, {-4.0, 0.0})) << "behind the camera";
  EXPECT_FALSE(outline_.classify(view_, {0.4, 0.0})) << "too near";
  EXPECT_EQ(outline_.logPerson(view_, {-4.0, 0.0}), 0.0);
}

// Bug: who stood at the picture's edge was a thing, for they had but one side.
TEST_F(PersonOutlineTest, SaysNothingOfWhoIsCutByThePicture) {
  EXPECT_TRUE(outline_.classify(view_, {1.5, 0.0})) << "without feet";
  EXPECT_FALSE(outline_.classify(view_, {1.25, 0.0})) << "without head and feet";
  EXPECT_TRUE(outline_.classify(view_, {4.0, 2.3}));
  EXPECT_FALSE(outline_.classify(view_, {4.0, 2.5}));
}

// Bug: who stood half behind a door's frame was a thing.
TEST_F(PersonOutlineTest, SaysNothingOfWhoIsHalfHidden) {
  view_.depth_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(4.5));
  EXPECT_TRUE(outline_.classify(view_, kPlace_m));
  view_.depth_m.colRange(at(-0.1, 1.0).x, 640).setTo(2.0F);
  EXPECT_TRUE(outline_.classify(view_, kPlace_m)) << "an elbow is hidden";
  view_.depth_m.colRange(at(0.0, 1.0).x, 640).setTo(2.0F);
  EXPECT_FALSE(outline_.classify(view_, kPlace_m));
}

TEST_F(PersonOutlineTest, OneLookIsNeverSure) {
  for (double y = -1.0; y < 1.0; y += 0.1) {
    EXPECT_GT(outline_.logPerson(view_, {3.0, y}), -1.5) << "a wall";
  }
  drawPerson();
  EXPECT_LT(outline_.logPerson(view_, kPlace_m), 1.5);
}

}  // namespace
}  // namespace heel
