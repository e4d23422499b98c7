// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/view/scene_picture.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

namespace heel {
namespace {

/// A red wall at 4 m and a green one at 3 m in front of its middle.
ViewScene twoWalls() {
  const auto cloud = pcl::make_shared<ColorCloud>();
  const auto add = [&](float x, float half, std::uint8_t r, std::uint8_t g) {
    for (float y = -half; y <= half; y += 0.01F) {
      for (float z = 0.0F; z <= 2.0F * half; z += 0.01F) {
        pcl::PointXYZRGB point(r, g, 0);
        point.getVector3fMap() << x, y, z;
        cloud->push_back(point);
      }
    }
  };
  add(4.0F, 1.0F, 255, 0);
  add(3.0F, 0.3F, 0, 255);
  ViewScene scene;
  scene.cloud = cloud;
  return scene;
}

cv::Vec3b at(const cv::Mat& picture, double x, double y) {
  return picture.at<cv::Vec3b>(static_cast<int>(y), static_cast<int>(x));
}

const ViewPoint kFrom{{0.0, 0.0, 0.3}, {3.0, 0.0, 0.3}};

TEST(ScenePicture, ShowsWhatIsInFront) {
  cv::Mat picture;
  drawScene(twoWalls(), kFrom, picture);
  ASSERT_EQ(picture.size(), cv::Size(960, 720));
  EXPECT_EQ(at(picture, 480, 360), cv::Vec3b(0, 255, 0));
  EXPECT_EQ(at(picture, 480 + 780 * 0.6 / 4.0, 360), cv::Vec3b(0, 0, 255)) << "beside it";
}

TEST(ScenePicture, LeavesNoHolesInAWall) {
  ViewScene scene = twoWalls();
  scene.drawn.camera.fx = 300.0;  // its pixels are 1 cm apart at 3 m
  cv::Mat picture, green;
  drawScene(scene, kFrom, picture);
  cv::inRange(picture(cv::Rect(420, 300, 120, 120)), cv::Scalar(0, 255, 0), cv::Scalar(0, 255, 0),
              green);
  EXPECT_EQ(cv::countNonZero(green), 120 * 120);
}

TEST(ScenePicture, TintsTheMarkedPoints) {
  ViewScene scene = twoWalls();
  for (std::size_t i = 0; i < scene.cloud->size(); ++i) {
    scene.marked.push_back(static_cast<pcl::index_t>(i));
  }
  cv::Mat picture;
  drawScene(scene, kFrom, picture);
  EXPECT_NE(at(picture, 480, 360), cv::Vec3b(0, 255, 0));
}

TEST(ScenePicture, DrawsTheTargetInItsColour) {
  ViewScene scene = twoWalls();
  DrawnTrack target;
  target.position_m = {2.0, 0.0};
  target.height_m = 1.0;
  target.is_target = true;
  scene.drawn.tracks = {target};
  cv::Mat picture, orange;
  drawScene(scene, kFrom, picture);
  cv::inRange(picture, palette::kTarget, palette::kTarget, orange);
  EXPECT_GT(cv::countNonZero(orange), 200);
}

TEST(ScenePicture, OfNothingIsTheEmptyFloor) {
  ViewScene scene;
  scene.cloud = pcl::make_shared<ColorCloud>();
  cv::Mat picture;
  drawScene(scene, kFrom, picture);
  EXPECT_FALSE(picture.empty());
}

}  // namespace
}  // namespace heel
