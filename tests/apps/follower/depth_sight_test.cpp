// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_sight.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace heel {
namespace {

constexpr PinholeCamera kCamera{320, 240, 300.0, 300.0, 160.0, 120.0};
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
const Eigen::Vector2d kPlace(3.0, 0.0);
const Eigen::Vector2d kSide(0.0, 0.45);

/// A level camera 1.2 m over the floor: x forward, y to the left, z up.
Eigen::Isometry3d cameraFromFloor() {
  Eigen::Isometry3d T_floor_camera = Eigen::Isometry3d::Identity();
  T_floor_camera.linear().col(0) = -Eigen::Vector3d::UnitY();
  T_floor_camera.linear().col(1) = -Eigen::Vector3d::UnitZ();
  T_floor_camera.linear().col(2) = Eigen::Vector3d::UnitX();
  T_floor_camera.translation().z() = 1.2;
  return T_floor_camera.inverse();
}

/// Upright boards before a camera, seen from `left_m` to `right_m` of its axis.
class Depths {
 public:
  explicit Depths(float background_m) : image_(240, 320, CV_32FC1, cv::Scalar(background_m)) {}

  Depths& board(double depth_m, double left_m, double right_m) {
    const int first = static_cast<int>(kCamera.cx - left_m / depth_m * kCamera.fx);
    const int last = static_cast<int>(kCamera.cx + right_m / depth_m * kCamera.fx);
    image_(cv::Rect(first, 0, last - first, image_.rows)) = static_cast<float>(depth_m);
    return *this;
  }

  double logPerson(double depth_sigma_m = 0.0) const {
    return sight().logPerson(kPlace, kSide, depth_sigma_m);
  }
  Sight at(const Eigen::Vector2d& place_m) const { return sight().at(place_m); }
  std::optional<Eigen::Vector2d> seenTo(const Eigen::Vector2d& place_m) const {
    return sight().seenTo(place_m);
  }

 private:
  DepthSight sight() const { return {image_, kCamera, cameraFromFloor()}; }
  cv::Mat image_;
};

TEST(DepthSight, TellsWhatIsBeforeAPlaceAndBehindIt) {
  const Depths wall(3.0F);
  EXPECT_EQ(wall.at({2.0, 0.0}), Sight::kFree);
  EXPECT_EQ(wall.at({3.0, 0.0}), Sight::kUnknown) << "somebody may stand there";
  EXPECT_EQ(wall.at({4.0, 0.0}), Sight::kHidden);
  EXPECT_EQ(wall.at({-2.0, 0.0}), Sight::kOutside);
  EXPECT_EQ(wall.at({2.0, 3.0}), Sight::kOutside);
}

TEST(DepthSight, TellsWhereWhatHidesAPlaceIs) {
  const Depths board = Depths(6.0F).board(2.0, 0.5, 0.1);
  ASSERT_TRUE(board.seenTo({4.0, 0.4}));
  EXPECT_LT((*board.seenTo({4.0, 0.4}) - Eigen::Vector2d(2.0, 0.2)).norm(), 1e-6);
  const Eigen::Vector2d beside(4.0, -0.4);
  EXPECT_EQ(board.seenTo(beside), beside) << "it is seen beside the board";
  EXPECT_FALSE(board.seenTo({2.0, 0.0})) << "it is the board's";
}

TEST(DepthSight, WhoStandsInTheOpenIsRatherAPerson) {
  EXPECT_GT(Depths(6.0F).board(3.0, 0.25, 0.25).logPerson(), 0.0);
}

TEST(DepthSight, WhoLeansAtSomethingMayBeAPerson) {
  EXPECT_GT(Depths(6.0F).board(3.0, 0.25, 1.0).logPerson(), 0.0);
}

TEST(DepthSight, APieceOfAWallIsRatherAThing) { EXPECT_LT(Depths(3.0F).logPerson(), -1.0); }

TEST(DepthSight, WhatIsSeenThroughIsRatherAThing) { EXPECT_LT(Depths(6.0F).logPerson(), -1.0); }

TEST(DepthSight, WhatIsHiddenAtTheSidesSaysNothing) {
  EXPECT_EQ(Depths(1.0F).board(3.0, 0.25, 0.25).logPerson(), 0.0);
}

TEST(DepthSight, WithoutDepthsNothingIsSaid) {
  const Depths none(kNone);
  EXPECT_EQ(none.logPerson(), 0.0);
  EXPECT_EQ(none.at(kPlace), Sight::kUnknown);
}

TEST(DepthSight, NoisyDepthsAreHeldForOneSurface) {
  const Depths rough = Depths(3.5F).board(3.0, 0.25, 0.25);
  EXPECT_GT(rough.logPerson(0.0), 0.0);
  EXPECT_LT(rough.logPerson(0.3), -1.0);
}

}  // namespace
}  // namespace heel
