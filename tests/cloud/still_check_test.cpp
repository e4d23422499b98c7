// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/ground_plane.hpp>
#include <heel/cloud/still_check.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

const PinholeCamera kStillCamera = {160, 120, 140.0, 140.0, 79.5, 59.5};
const Eigen::Isometry3d kMounted = baseFromCamera({1.1, 0.1, 0.0});

/// Where the camera's robot stands, and a block as wide as a person before it.
struct View {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  std::vector<Eigen::Vector2d> people = {};
};

/// How far a ray goes until it meets a box.
double distanceTo(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& along) {
  double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double a = (box.min()[i] - from[i]) / along[i], b = (box.max()[i] - from[i]) / along[i];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  if (enters > leaves) return std::numeric_limits<double>::infinity();
  return enters > 0.0 ? enters : leaves;
}

/// A room of 6 by 5 m, seen from 1 m before the middle of its back wall.
cv::Mat depthOf(const View& view) {
  const Eigen::Isometry3d T = Eigen::Translation3d(view.x_m, view.y_m, 0.0) *
                              Eigen::AngleAxisd(view.yaw_rad, Eigen::Vector3d::UnitZ()) * kMounted;
  cv::Mat depth_m(kStillCamera.height, kStillCamera.width, CV_32FC1);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const Eigen::Vector3d ray((u - kStillCamera.cx) / kStillCamera.fx,
                                (v - kStillCamera.cy) / kStillCamera.fy, 1.0);
      const Eigen::Vector3d from = T.translation();
      const Eigen::Vector3d along = T.linear() * ray;
      double nearest =
          distanceTo({Eigen::Vector3d(-1, -2.5, 0), Eigen::Vector3d(5, 2.5, 2.5)}, from, along);
      for (const Eigen::Vector2d& place : view.people) {
        const Eigen::AlignedBox3d body(Eigen::Vector3d(place.x() - 0.15, place.y() - 0.25, 0.0),
                                       Eigen::Vector3d(place.x() + 0.15, place.y() + 0.25, 1.8));
        nearest = std::min(nearest, distanceTo(body, from, along));
      }
      depth_m.at<float>(v, u) = static_cast<float>(nearest);
    }
  }
  return depth_m;
}

std::optional<double> leavesAfter(const std::vector<View>& views, double sigma = 0.0) {
  StillCheck check(kStillCamera, kMounted, sigma);
  for (std::size_t i = 0; i < views.size(); ++i) {
    check.add(static_cast<double>(i), depthOf(views[i]));
  }
  return check.leaves_s();
}

TEST(StillCheck, SeesARobotDriveAndTurn) {
  std::vector<View> driving, turning;
  for (int i = 0; i < 10; ++i) {
    driving.push_back({0.3 * i, 0.0, 0.0});
    turning.push_back({0.0, 0.0, 0.2 * i});
  }
  ASSERT_TRUE(leavesAfter(driving));
  EXPECT_LE(*leavesAfter(driving), 3.0);
  ASSERT_TRUE(leavesAfter(turning));
  EXPECT_LE(*leavesAfter(turning), 6.0) << "the walls of a room are alike";
}

TEST(StillCheck, IsNotMistakenByPeople) {
  std::vector<View> walking, crowd;
  for (int i = 0; i < 20; ++i) {
    walking.push_back({0, 0, 0, {{1.2, 1.0 - 0.1 * i}}});
    crowd.push_back({0, 0, 0, {{1.5, 0.5}, {2.0, -0.7}, {3.0, -1.2 + 0.1 * i}}});
  }
  crowd.front().people.clear();
  EXPECT_FALSE(leavesAfter(walking));
  EXPECT_FALSE(leavesAfter(crowd));
}

TEST(StillCheck, AllowsForTheNoiseOfDepth) {
  std::vector<View> views(10, View{1.0, 0.0, 0.0});
  views.front() = {};
  EXPECT_TRUE(leavesAfter(views));
  EXPECT_FALSE(leavesAfter(views, 0.05));
}

TEST(StillCheck, WantsTheSceneToStayAnother) {
  std::vector<View> views(10);
  views[4].x_m = views[5].x_m = 1.0;
  EXPECT_FALSE(leavesAfter(views)) << "two bad images";
  views[6].x_m = 1.0;
  EXPECT_EQ(leavesAfter(views), 4.0);
}

TEST(StillCheck, LooksOnceASecond) {
  StillCheck check(kStillCamera, kMounted, 0.0);
  EXPECT_TRUE(check.isDue(5.0));
  check.add(5.0, depthOf({}));
  EXPECT_FALSE(check.isDue(5.9));
  EXPECT_TRUE(check.isDue(6.0));
  EXPECT_THROW(check.add(6.0, cv::Mat(10, 10, CV_32FC1)), std::invalid_argument);
}

}  // namespace
}  // namespace heel
