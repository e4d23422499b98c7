// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/allocation_count.hpp"
#include "tests/support/stereo_scene.hpp"
#include <heel/apps/follower/obstacle_points.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

using test::render;
using test::Surface;

constexpr double kCamera_m = 1.0;  // Over the floor; it looks ahead.

CameraSetup setupOf(SensorKind sensor, int width = 640) {
  CameraSetup setup;
  setup.sensor = sensor;
  const double f = 0.78125 * width;
  setup.camera = StereoCamera{
      {width, width * 3 / 4, f, f, width / 2.0 - 0.5, width * 3.0 / 8.0 - 0.5}, 0.12, 0.0};
  setup.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  setup.T_base_camera.translation() << 0.05, 0.06, kCamera_m;
  return setup;
}

/// The part of a plane at a height under (over, if negative) the camera, from `near` to `far` ahead
/// and from `left` to `right` of it, as it is drawn. Its disparity is linear in v.
Surface level(const CameraSetup& setup, double under_m, double near_m, double far_m) {
  const PinholeCamera& c = setup.camera.left;
  Surface surface;
  const double v_far = c.cy + c.fy * under_m / far_m, v_near = c.cy + c.fy * under_m / near_m;
  surface.area = cv::Rect2d(0.0, v_far, c.width, v_near - v_far);
  // disparity = fx b / z, and z = fy under / (v - cy).
  surface.slope_v = setup.camera.baseline_m / under_m;
  surface.disparity = -surface.slope_v * c.cy;
  return surface;
}

Surface upright(const CameraSetup& setup, double ahead_m, const cv::Rect2d& area) {
  Surface surface;
  surface.area = area;
  surface.disparity = setup.camera.left.fx * setup.camera.baseline_m / ahead_m;
  return surface;
}

cv::Rect2d wholeImage(const CameraSetup& setup) {
  return {0.0, 0.0, static_cast<double>(setup.camera.left.width),
          static_cast<double>(setup.camera.left.height)};
}

Frame frameOf(const std::vector<Surface>& surfaces) {
  const test::StereoScene scene = render(surfaces);
  Frame frame;
  frame.image_bgr = scene.left;
  frame.right_bgr = scene.right;
  return frame;
}

/// A wall at 4 m, which is out of range, and the floor before it, down to `under_m` under the
/// camera.
std::vector<Surface> room(const CameraSetup& setup, double under_m = kCamera_m) {
  return {upright(setup, 4.0, wholeImage(setup)), level(setup, under_m, 1.5, 4.0)};
}

std::vector<Surface> with(std::vector<Surface> room, const Surface& thing) {
  room.push_back(thing);
  return room;
}

/// An RGB-D frame whose pixels are all at one depth.
Frame flat(const CameraSetup& setup, float depth_m) {
  Frame frame;
  const cv::Size size(setup.camera.left.width, setup.camera.left.height);
  frame.image_bgr = cv::Mat::zeros(size, CV_8UC3);
  frame.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar::all(depth_m));
  return frame;
}

TEST(ObstaclePoints, AStereoTableTopIsWhereItIs) {
  const CameraSetup setup = setupOf(SensorKind::kStereo);
  ObstaclePoints obstacles(setup);
  const auto points = obstacles.of(frameOf(with(room(setup), level(setup, 0.25, 0.9, 1.6))));
  ASSERT_GT(points.size(), 200U);
  int good = 0;
  for (const Eigen::Vector3f& p : points) {
    const bool on_top = std::abs(p.z() - 0.75F) < 0.06F && p.x() > 0.85F && p.x() < 1.8F;
    good += on_top ? 1 : 0;
  }
  EXPECT_GT(good, 0.95 * static_cast<double>(points.size()));
}

// The floor ends 2.6 m ahead of the camera, and goes on a step lower.
TEST(ObstaclePoints, AStepDownIsWhereTheFloorIsSeenThrough) {
  const CameraSetup setup = setupOf(SensorKind::kStereo);
  ObstaclePoints obstacles(setup);
  EXPECT_LT(obstacles.of(frameOf(room(setup))).size(), 20U);
  const Eigen::Vector3f step(2.9F, 0.02F, 0.0F);
  EXPECT_TRUE(obstacles.seesThrough(step)) << "floor is seen there";
  const auto points =
      obstacles.of(frameOf(with(room(setup, kCamera_m + 0.3), level(setup, kCamera_m, 1.5, 2.6))));
  ASSERT_GT(points.size(), 200U);
  int good = 0;
  for (const Eigen::Vector3f& p : points) good += p.x() > 2.5F && p.x() < 4.1F ? 1 : 0;
  EXPECT_GT(good, 0.95 * static_cast<double>(points.size()));
  const auto nearest = std::min_element(points.begin(), points.end(),
                                        [](auto& a, auto& b) { return a.x() < b.x(); });
  EXPECT_NEAR(nearest->x(), 2.65F, 0.15F);
  const auto isStep = [](const Eigen::Vector3f& p) { return p.z() == 0.0F; };
  EXPECT_TRUE(std::all_of(points.begin(), points.end(), isStep));
  EXPECT_FALSE(obstacles.seesThrough(step)) << "nothing is seen there";
}

TEST(ObstaclePoints, SeesThroughWhereAllAroundIsFartherAway) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  obstacles.of(flat(setup, 2.0F));
  EXPECT_TRUE(obstacles.seesThrough({1.4F, 0.06F, 1.0F}));
  EXPECT_FALSE(obstacles.seesThrough({1.6F, 0.06F, 1.0F})) << "it may be a part of what is seen";
  EXPECT_FALSE(obstacles.seesThrough({2.5F, 0.06F, 1.0F})) << "hidden";
  EXPECT_FALSE(obstacles.seesThrough({1.4F, 0.06F, 0.1F})) << "below the picture";
  EXPECT_FALSE(obstacles.seesThrough({-1.0F, 0.06F, 1.0F})) << "behind the camera";
  Frame post = flat(setup, 2.0F);
  post.depth_m(cv::Rect(322, 0, 4, 480)).setTo(std::numeric_limits<float>::quiet_NaN());
  obstacles.of(post);
  EXPECT_FALSE(obstacles.seesThrough({1.4F, 0.06F, 1.0F})) << "beside what has no depth";
}

TEST(ObstaclePoints, ABlankWallHasNoStereoPoints) {
  const CameraSetup setup = setupOf(SensorKind::kStereo);
  ObstaclePoints obstacles(setup);
  Surface wall = upright(setup, 1.2, wholeImage(setup));
  EXPECT_GT(obstacles.of(frameOf({wall})).size(), 2000U);
  wall.contrast = 0.0;
  EXPECT_LT(obstacles.of(frameOf({wall})).size(), 20U);
}

TEST(ObstaclePoints, ThePictureOfABlankThingIsItsRim) {
  const CameraSetup setup = setupOf(SensorKind::kStereo);
  ObstaclePoints obstacles(setup);
  Surface board = upright(setup, 1.2, {200.0, 120.0, 240.0, 240.0});
  board.contrast = 0.0;
  board.colour_bgr = {30, 30, 30};
  const auto points = obstacles.of(frameOf(with(room(setup), board)));
  ASSERT_GT(points.size(), 20U);
  const float left_m = static_cast<float>(0.06 + 1.2 * (319.5 - 200.0) / 500.0);
  const float right_m = static_cast<float>(0.06 - 1.2 * (440.0 - 319.5) / 500.0);
  for (const Eigen::Vector3f& p : points) {
    EXPECT_NEAR(p.x(), 1.25F, 0.2F);
    EXPECT_LT(std::min(std::abs(p.y() - left_m), std::abs(p.y() - right_m)), 0.12F);
  }
}

TEST(ObstaclePoints, WhereFloorIsNeededNoDepthIsAStepAtItsNearRim) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePointsParams params;
  const Frame blank = flat(setup, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(ObstaclePoints(setup, params).of(blank).empty());
  params.needs_floor = true;
  params.max_range_m = 2.5;
  ObstaclePoints obstacles(setup, params);
  const auto& points = obstacles.of(blank);
  ASSERT_GT(points.size(), 500U);
  const double nearest_m = 1.0 / (240.0 / 500.0);  // The picture ends there.
  for (const Eigen::Vector3f& p : points) {
    ASSERT_EQ(p.z(), 0.0F);
    ASSERT_GT(p.x(), 0.05 + nearest_m - 0.02);
    ASSERT_LT(p.x(), 0.05 + nearest_m + 0.2) << "behind its rim there may be floor";
    ASSERT_LT((p.head<2>() - Eigen::Vector2f(0.05F, 0.06F)).norm(), 2.5F);
  }
}

TEST(ObstaclePoints, MeasuredDepthNeedsNoTexture) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  const auto& points = obstacles.of(flat(setup, 1.5F));
  ASSERT_GT(points.size(), 10000U);
  for (const Eigen::Vector3f& p : points) {
    ASSERT_NEAR(p.x(), 1.55F, 1e-4F);
    ASSERT_GE(p.z(), 0.08F);
    ASSERT_LE(p.z(), 1.2F);
  }
}

TEST(ObstaclePoints, KeepsToItsHeights) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePointsParams params;
  params.min_height_m = 0.5;
  params.max_height_m = 0.9;
  ObstaclePoints obstacles(setup, params);
  const auto& points = obstacles.of(flat(setup, 1.5F));
  const auto by_height = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), by_height);
  ASSERT_NE(low, points.end());
  EXPECT_NEAR(low->z(), 0.5F, 0.013F);  // A pixel is 12 mm there.
  EXPECT_GE(low->z(), 0.5F);
  EXPECT_NEAR(high->z(), 0.9F, 0.013F);
  EXPECT_LE(high->z(), 0.9F);
}

TEST(ObstaclePoints, KeepsToItsRangeOnTheFloor) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  EXPECT_TRUE(obstacles.of(flat(setup, 2.1F)).empty());
  const auto& points = obstacles.of(flat(setup, 1.9F));
  ASSERT_FALSE(points.empty());
  for (const Eigen::Vector3f& p : points) {
    ASSERT_LE(std::hypot(p.x() - 0.05F, p.y() - 0.06F), 2.0F + 1e-4F);
  }
}

TEST(ObstaclePoints, PlacesAPostAsTheWholeImageDoes) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  Frame frame = flat(setup, 4.0F);
  frame.depth_m.rowRange(360, 480).setTo(0.0F);  // The floor is nearer.
  frame.depth_m(cv::Rect(420, 200, 20, 200)).setTo(1.5F);
  const auto& points = obstacles.of(frame);
  ASSERT_FALSE(points.empty());
  const auto by_side = [](const auto& a, const auto& b) { return a.y() < b.y(); };
  const auto [right, left] = std::minmax_element(points.begin(), points.end(), by_side);
  // Columns 420 to 439; a pixel of the small image is 12 mm there.
  EXPECT_NEAR(left->y(), 0.06 - 1.5 * (420.0 - 319.5) / 500.0, 0.012);
  EXPECT_NEAR(right->y(), 0.06 - 1.5 * (439.0 - 319.5) / 500.0, 0.012);
}

TEST(ObstaclePoints, WhereThereIsNoDepthThereIsNoPoint) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  for (const float none : {std::numeric_limits<float>::quiet_NaN(), 0.0F, -1.0F,
                           std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE(obstacles.of(flat(setup, none)).empty()) << none;
  }
}

TEST(ObstaclePoints, LeavesSmallImagesAsTheyAre) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd, 80);
  ObstaclePointsParams params;
  params.min_height_m = -10.0;
  params.max_height_m = 10.0;
  ObstaclePoints obstacles(setup, params);
  EXPECT_EQ(obstacles.of(flat(setup, 1.0F)).size(), 80U * 60U);
}

TEST(ObstaclePoints, AFrameLeavesNothingForTheNext) {
  const CameraSetup setup = setupOf(SensorKind::kStereo);
  ObstaclePoints obstacles(setup);
  const Frame table = frameOf(with(room(setup), level(setup, 0.25, 0.9, 1.6)));
  const auto first = obstacles.of(table);
  EXPECT_LT(obstacles.of(frameOf(room(setup))).size(), first.size() / 10);
  EXPECT_EQ(obstacles.of(table), first);
}

TEST(ObstaclePoints, OfMeasuredDepthAllocatesNothingOnceWarm) {
  const CameraSetup setup = setupOf(SensorKind::kRgbd);
  ObstaclePoints obstacles(setup);
  const Frame frame = flat(setup, 1.5F);
  obstacles.of(frame);
  const long before = test::allocations();
  obstacles.of(frame);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace heel
