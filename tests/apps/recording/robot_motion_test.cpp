// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/robot_motion.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace heel {
namespace {

using test::messageOf;
using test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;

Eigen::Isometry3d pose(double x, double y, double yaw_rad) {
  return Eigen::Translation3d(x, y, 0.0) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

TEST(Trajectory, GoesStraightFromPoseToPose) {
  Trajectory way;
  way.add(1.0, pose(0, 0, 0));
  way.add(1.4, pose(0.8, 0.4, 1.0));
  const auto there = way.at(1.1);
  ASSERT_TRUE(there);
  EXPECT_TRUE(there->isApprox(pose(0.2, 0.1, 0.25), 1e-12));
  EXPECT_TRUE(way.at(1.4)->isApprox(pose(0.8, 0.4, 1.0), 1e-12));
}

TEST(Trajectory, TurnsTheShortWayRound) {
  Trajectory way;
  way.add(0.0, pose(0, 0, 3.0));
  way.add(0.2, pose(0, 0, -3.0));
  EXPECT_TRUE(way.at(0.1)->isApprox(pose(0, 0, M_PI), 1e-12));
}

TEST(Trajectory, TakesPosesInAnyOrderAndTheFirstOfTwo) {
  Trajectory way;
  for (const double s : {0.4, 0.0, 0.2, 0.6}) way.add(s, pose(s, 0, 0));
  way.add(0.2, pose(7, 7, 0));
  EXPECT_EQ(way.size(), 4U);
  for (const double s : {0.0, 0.1, 0.2, 0.3, 0.5, 0.6}) {
    EXPECT_NEAR(way.at(s)->translation().x(), s, 1e-12);
  }
}

TEST(Trajectory, LeavesOutWhatIsNoPlaceOfARobot) {
  Trajectory way;
  way.add(0.0, pose(std::nan(""), 0, 0));
  way.add(0.1, pose(1e10, 0, 0));
  way.add(std::nan(""), pose(0, 0, 0));
  EXPECT_TRUE(way.empty());
}

TEST(Trajectory, IsNotKnownInGapsAndBeyondItsEnds) {
  Trajectory way;
  for (const double s : {0.0, 0.5, 2.0, 2.5}) way.add(s, pose(s, 0, 0));
  EXPECT_FALSE(way.at(1.2)) << "1.5 s without a pose";
  EXPECT_TRUE(way.at(0.5));
  EXPECT_TRUE(way.at(2.0));
  EXPECT_EQ(way.at(2.59)->translation().x(), 2.5) << "the last holds for a tenth of a second";
  EXPECT_FALSE(way.at(2.61));
  EXPECT_FALSE(way.at(-0.11));
  EXPECT_FALSE(Trajectory().at(0.0));
}

TEST(Trajectory, LeavesItsPlaceByDrivingAndByTurning) {
  Trajectory driving, turning;
  for (int i = 0; i <= 10; ++i) {
    driving.add(0.1 * i, pose(0.01 * i, 0, 0));
    turning.add(0.1 * i, pose(0, 0, 0.001 * i));
  }
  EXPECT_NEAR(*driving.leaves_s(0.0, 1.0, 8.0, 0.025), 0.3, 1e-12);
  EXPECT_NEAR(*driving.leaves_s(0.5, 1.0, 8.0, 0.025), 0.8, 1e-12);
  EXPECT_FALSE(driving.leaves_s(0.0, 0.2, 8.0, 0.025));
  EXPECT_NEAR(*turning.leaves_s(0.0, 1.0, 8.0, 0.025), 0.4, 1e-12) << "8 m away it is 0.032 m";
  EXPECT_FALSE(turning.leaves_s(0.0, 1.0, 2.0, 0.025));
}

std::optional<RobotMotion> motionOf(const char* file, const char* text) {
  const TempFolder folder;
  folder.write(file, text);
  return readFolderMotion(folder.path());
}

TEST(FolderMotion, IsReadFromTheWheels) {
  const auto motion =
      motionOf("odometry.csv", "stamp_s,x_m,y_m,yaw_rad\n0.0,0,0,0\n0.1,0.03,-0.5,0.2\n");
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_id, "odom");
  EXPECT_FALSE(motion->of_camera);
  EXPECT_TRUE(motion->poses.at(0.1)->isApprox(pose(0.03, -0.5, 0.2), 1e-12));
}

TEST(FolderMotion, IsReadFromTheCamerasTrajectory) {
  const auto motion =
      motionOf("groundtruth.txt", "# stamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 0 1\n");
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_id, "");
  EXPECT_TRUE(motion->of_camera);
  EXPECT_TRUE(motion->poses.at(1.5)->translation().isApprox(Eigen::Vector3d(1, 2, 3)));
}

TEST(FolderMotion, NamesTheLineThatIsBroken) {
  const TempFolder folder;
  EXPECT_FALSE(readFolderMotion(folder.path()));
  folder.write("odometry.csv", "stamp_s,x_m,y_m,yaw_rad\n0.0,0,0,0\n0.1,0,east,0\n");
  EXPECT_THAT(messageOf([&] { readFolderMotion(folder.path()); }),
              AllOf(HasSubstr("odometry.csv, line 3"), HasSubstr("'stamp_s,x_m,y_m,yaw_rad'")));
  folder.write("odometry.csv", "0.0,0,0\n");
  EXPECT_THAT(messageOf([&] { readFolderMotion(folder.path()); }), HasSubstr("line 1"));
  folder.write("odometry.csv", "stamp_s,x_m,y_m,yaw_rad\n");
  EXPECT_THAT(messageOf([&] { readFolderMotion(folder.path()); }), HasSubstr("lists nothing"));
}

}  // namespace
}  // namespace heel
