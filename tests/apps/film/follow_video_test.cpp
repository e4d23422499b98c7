// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/follow_run.hpp"
#include <heel/apps/film/follow_video.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <stdexcept>

namespace {

using Eigen::Vector2d;
using heel::FollowVideo;
using heel::FollowVideoFrame;
using heel::test::flatMap;
using heel::test::flatRun;
using heel::test::videoFrame;

const double kNan = std::nan("");

cv::Vec3b colorAt(const cv::Mat& picture, cv::Point2d at) {
  return picture.at<cv::Vec3b>(cvRound(at.y), cvRound(at.x));
}

TEST(FollowVideo, PictureIsOfTheStatedEvenSizeAndOfTheSameBytes) {
  FollowVideo video(flatMap(), {});
  cv::Mat first, second;
  video.draw(videoFrame(flatRun(), 600), first);
  video.draw(videoFrame(flatRun(), 600), second);
  EXPECT_EQ(first.size(), video.size());
  EXPECT_EQ(first.cols % 2 + first.rows % 2, 0);
  EXPECT_EQ(cv::norm(first, second, cv::NORM_INF), 0.0);
}

TEST(FollowVideo, EverybodyIsWhereTheyAre) {
  FollowVideo video(flatMap(), {});
  FollowVideoFrame frame;
  frame.robot_true.position = frame.robot_estimated.position = {1.0, 3.0};
  frame.person_true = Vector2d(3.0, 3.0);
  frame.obstacles = {{6.0, 4.0}};
  cv::Mat picture;
  video.draw(frame, picture);
  const cv::Point2d origin = video.pixelOf({1.0, 3.0}), right = video.pixelOf({2.0, 3.0}),
                    up = video.pixelOf({1.0, 4.0});
  EXPECT_GT(right.x, origin.x);
  EXPECT_NEAR(right.x - origin.x, origin.y - up.y, 1e-9) << "left is left, and y goes up";
  const cv::Vec3b person = colorAt(picture, video.pixelOf({3.0, 3.0}));
  EXPECT_GT(person[2], 200) << "the target is orange";
  EXPECT_LT(person[0], 80);
  EXPECT_EQ(colorAt(picture, video.pixelOf({5.2, 1.0})), cv::Vec3b(196, 186, 176)) << "a wall";
  EXPECT_EQ(colorAt(picture, video.pixelOf({6.0, 4.0})), cv::Vec3b(110, 90, 200));
}

TEST(FollowVideo, WhatIsSeenEndsAtWalls) {
  FollowVideo video(flatMap(), {});
  FollowVideoFrame frame = videoFrame(flatRun(), 0);
  frame = {};
  cv::Mat blind, seeing;
  video.draw(frame, blind);
  frame.view.camera = {640, 480, 530.0, 530.0, 319.5, 239.5};
  frame.view.T_floor_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // looks along x
  frame.view.T_floor_camera.translation() = Eigen::Vector3d(3.0, 1.4, 1.15);
  video.draw(frame, seeing);
  const auto in_front = video.pixelOf({4.4, 1.4}), behind_wall = video.pixelOf({6.0, 1.4});
  EXPECT_NE(colorAt(seeing, in_front), colorAt(blind, in_front));
  EXPECT_EQ(colorAt(seeing, behind_wall), colorAt(blind, behind_wall));
}

TEST(FollowVideo, DrawsNonsenseWithoutHarm) {
  FollowVideo video(flatMap(), {});
  cv::Mat picture;
  EXPECT_NO_THROW(video.draw({}, picture));
  FollowVideoFrame frame = videoFrame(flatRun(), 600);
  frame.robot_true.position = frame.robot_estimated.position = {kNan, kNan};
  frame.person_true = frame.target_estimate = Vector2d(1e9, kNan);
  frame.path = {{kNan, 0.0}, {1e9, -1e9}};
  frame.obstacles = {{1e6, 1e6}, {kNan, kNan}};
  frame.view.T_floor_camera.translation().setConstant(kNan);
  frame.view.tracks.clear();
  frame.view.blobs.clear();
  EXPECT_NO_THROW(video.draw(frame, picture));
}

TEST(FollowVideo, GoesAlongWithTheRobotWhereThereAreNoWalls) {
  FollowVideo video(heel::OccupancyGrid({-50, -50}, 0.1, 1000, 1000), {});
  FollowVideoFrame frame;
  cv::Mat picture;
  video.draw(frame, picture);
  const cv::Point2d before = video.pixelOf({0.0, 0.0});
  frame.robot_estimated.position = frame.robot_true.position = {30.0, -20.0};
  video.draw(frame, picture);
  EXPECT_NEAR(cv::norm(video.pixelOf({30.0, -20.0}) - before), 0.0, 1e-9);
}

TEST(FollowVideo, RefusesAnEmptyMap) {
  EXPECT_THROW(FollowVideo({}, {}), std::invalid_argument);
  EXPECT_NO_THROW(FollowVideo(heel::OccupancyGrid({0, 0}, 0.1, 5, 5), {}));
}

}  // namespace
