// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/picture_parts.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include <cmath>

namespace {

using heel::DrawnFrame;
using heel::DrawnTrack;
namespace palette = heel::palette;

/// A camera 1.5 m over the floor that looks ahead along x, level.
Eigen::Isometry3d levelMount() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.translation().z() = 1.5;
  return T;
}

DrawnFrame someScene() {
  DrawnFrame scene;
  scene.image_bgr = cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 90, 90));
  scene.camera = {640, 480, 500.0, 500.0, 319.5, 239.5};
  scene.T_floor_camera = levelMount();
  scene.frame = 7;
  scene.stamp_s = 1.2;
  scene.state = "following";
  return scene;
}

DrawnTrack someTrack(bool is_target, Eigen::Vector2d position_m) {
  DrawnTrack track;
  track.id = 3;
  track.is_target = is_target;
  track.position_m = position_m;
  track.confidence = 0.9;
  return track;
}

cv::Mat draw(const DrawnFrame& scene) {
  cv::Mat picture;
  heel::annotate(scene, {}, picture);
  return picture;
}

/// How many pixels have just this colour.
int countOf(const cv::Mat& picture, const cv::Scalar& color) {
  cv::Mat same;
  cv::inRange(picture, color, color, same);
  return cv::countNonZero(same);
}

TEST(ProjectToImage, FollowsThePinholeModel) {
  const heel::PinholeCamera camera{640, 480, 500.0, 400.0, 320.0, 240.0};
  // 4 m ahead, 1 m to the left, 0.5 m over the floor: 1 m under the camera.
  const auto pixel = heel::projectToImage({4.0, 1.0, 0.5}, camera, levelMount());
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR(pixel->x, 320.0 - 500.0 / 4.0, 1e-9);
  EXPECT_NEAR(pixel->y, 240.0 + 400.0 / 4.0, 1e-9);
  EXPECT_FALSE(heel::projectToImage({-1.0, 0.0, 0.0}, camera, levelMount()).has_value());
  EXPECT_FALSE(heel::projectToImage({4.0, 0.0, 0.0}, {}, levelMount()).has_value());
}

TEST(VisibleFloor, IsWhereTheImagesRaysMeetTheFloor) {
  const heel::PinholeCamera camera{640, 480, 320.0, 240.0, 320.0, 240.0};  // 45 deg to each edge
  const auto floor_m = heel::visibleFloor(camera, levelMount(), 8.0);
  double nearest_m = 1e9, widest = 0.0;
  for (const auto& p : floor_m) {
    EXPECT_LE(p.norm(), 8.0 + 1e-9);
    nearest_m = std::min(nearest_m, p.x());
    widest = std::max(widest, std::abs(p.y() / p.x()));
  }
  EXPECT_NEAR(nearest_m, 1.5, 1e-9);  // looking 45 deg down from 1.5 m
  EXPECT_NEAR(widest, 1.0, 1e-9);
  EXPECT_TRUE(heel::visibleFloor({}, levelMount(), 8.0).empty());
}

TEST(Annotate, PictureIsOfTheStatedEvenSizeAndOfTheSameBytes) {
  const DrawnFrame scene = someScene();
  const cv::Mat first = draw(scene);
  EXPECT_EQ(first.size(), heel::pictureSize());
  EXPECT_EQ(first.cols % 2, 0);
  EXPECT_EQ(first.rows % 2, 0);
  EXPECT_EQ(cv::norm(first, draw(scene), cv::NORM_INF), 0.0);
  heel::AnnotateParams odd;
  odd.panel_height_px = 301;
  EXPECT_EQ(heel::pictureSize(odd).height % 2, 0);
  cv::Mat picture;
  heel::annotate(scene, odd, picture);
  EXPECT_EQ(picture.size(), heel::pictureSize(odd));
}

TEST(Annotate, OnlyTheTargetIsOrange) {
  DrawnFrame scene = someScene();
  scene.tracks = {someTrack(false, {4.0, 0.5})};
  const cv::Mat without = draw(scene);
  scene.tracks = {someTrack(true, {4.0, 0.5})};
  const cv::Mat with = draw(scene);
  const cv::Rect panels(0, 44, without.cols, 600);
  EXPECT_EQ(countOf(without(panels), palette::kTarget), 0);
  EXPECT_GT(countOf(with(panels), palette::kTarget), 300);
  EXPECT_GT(countOf(without(panels), palette::kTrack), 50);
}

TEST(Annotate, TargetIsDrawnWhereItStandsInThePlan) {
  DrawnFrame scene = someScene();
  scene.tracks = {someTrack(true, {4.0, 1.0})};
  const cv::Mat picture = draw(scene);
  // 600 pixels for 8.5 m ahead and 0.6 m behind; the plan's middle is y = 0, left is positive.
  const double scale = 600.0 / 9.1;
  const int column = static_cast<int>(824 + 220 - 1.0 * scale);
  const int row = static_cast<int>(44 + 600 - (0.6 + 4.0) * scale);
  EXPECT_EQ(picture.at<cv::Vec3b>(row, column), cv::Vec3b(48, 150, 255));
}

TEST(Annotate, MaskIsOutlinedAndThePictureStaysAsItIs) {
  DrawnFrame scene = someScene();
  scene.mask = cv::Mat::zeros(480, 640, CV_8UC1);
  scene.mask(cv::Rect(80, 80, 160, 160)) = 255;
  scene.mask.at<uchar>(400, 500) = 255;  // a speck
  const cv::Mat picture = draw(scene);
  const auto at = [&](int x, int y) {  // the panel is 1.25 times as large
    return picture.at<cv::Vec3b>(44 + y * 5 / 4, 12 + x * 5 / 4);
  };
  const cv::Vec3b grey(90, 90, 90);
  EXPECT_GT(at(80, 160)[1], 180);
  EXPECT_EQ(at(160, 160), grey);
  EXPECT_EQ(at(400, 160), grey);
  EXPECT_EQ(at(500, 400), grey);
}

TEST(Annotate, DrawsWhatIsOutOfSightWithoutHarm) {
  DrawnFrame scene = someScene();
  scene.tracks = {someTrack(true, {-3.0, 0.0}), someTrack(false, {0.0, 0.0}),
                  someTrack(true, {1e6, 1e7}), someTrack(false, {0.15, 40.0})};
  scene.blobs = {{{-1.0, 0.0}, 10, true}, {{1e8, -1e8}, 1000000, false}};
  EXPECT_NO_THROW(draw(scene));
  scene.image_bgr.release();  // an unorganized cloud
  scene.camera = {};
  EXPECT_NO_THROW(draw(scene));
}

TEST(Annotate, RefusesAMaskOfAnotherSize) {
  DrawnFrame scene = someScene();
  scene.mask = cv::Mat::zeros(48, 64, CV_8UC1);
  EXPECT_THROW(draw(scene), std::invalid_argument);
}

TEST(FittedText, CutsWhatIsTooWide) {
  EXPECT_EQ(heel::fittedText("short", 500), "short");
  const std::string cut = heel::fittedText(std::string(200, 'm'), 300);
  EXPECT_LE(heel::textWidth(cut), 300);
  EXPECT_EQ(cut.substr(cut.size() - 3), "...");
  EXPECT_EQ(heel::fittedText("text", 0), "");
}

}  // namespace
