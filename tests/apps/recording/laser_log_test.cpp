// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/laser_log.hpp>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <string>
#include <vector>

namespace heel {
namespace {

const char* const kSmallLog =
    "# a comment\n"
    "PARAM robot_length 0.47 1.0 host 1.0\n"
    "ODOM 5 5 0 0 0 0 0.1 host 0.1\n"
    "ODOM 6 5 0 0 0 0 0.2 host 0.2\n"
    "FLASER 4 1.0 2.0 81.9 3.5 1.5 0.5 0.0 1.5 0.5 0.0 0.25 host 0.25\n"
    "ODOM 1.5 0.5 0 0 0 0 0.25 host 0.25\n"
    "ODOM 2.5 0.5 1.5707963 0 0 0 0.3 host 0.3\n"
    "FLASER 4 1.0 2.0 3.0 3.5 2.6 0.6 1.5 2.6 0.6 1.5 0.35 host 0.35\n";

TEST(CarmenLog, ChainsTheOdometryAndSkipsTheCorrections) {
  const test::TempFolder folder;
  const auto log = openLaserLog(folder.write("small.log", kSmallLog));
  LaserReading reading;
  ASSERT_TRUE(log->next(reading));
  EXPECT_EQ(reading.stamp_s, 0.25);
  ASSERT_EQ(reading.scan.ranges_m.size(), 4U);
  EXPECT_NEAR(reading.scan.angle(0), -M_PI / 2.0, 1e-12);
  EXPECT_NEAR(reading.scan.angle(2), 0.0, 1e-12);
  EXPECT_EQ(reading.scan.ranges_m[1], 2.0F);
  EXPECT_TRUE(std::isinf(reading.scan.ranges_m[2])) << "81.9 m is no return";
  EXPECT_NEAR((reading.odometry.position - Eigen::Vector2d(1.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((reading.reference->position - Eigen::Vector2d(1.5, 0.5)).norm(), 0.0, 1e-12);
  ASSERT_TRUE(log->next(reading));
  EXPECT_NEAR((reading.odometry.position - Eigen::Vector2d(2.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(reading.odometry.yaw_rad, M_PI / 2.0, 1e-6);
  EXPECT_FALSE(log->next(reading));
}

/// The readings of a log that is written here.
std::vector<LaserReading> readingsOf(const std::string& text, FloorPose* T_base_scanner = nullptr) {
  const test::TempFolder folder;
  const auto log = openLaserLog(folder.write("small.log", text));
  if (T_base_scanner != nullptr) *T_base_scanner = *log->T_base_scanner();
  std::vector<LaserReading> readings(1);
  while (log->next(readings.back())) readings.push_back(readings.back());
  readings.pop_back();
  return readings;
}

TEST(CarmenLog, GoesAlongWithTheScansPosesWhereNobodyHasCorrectedThem) {
  FloorPose T_base_scanner;
  const auto readings = readingsOf(
      "ODOM 5 5 0 0.3 0 0 0.1 host 0.1\n"
      "FLASER 2 1.0 2.0 5.22 5.0 0.0 5.02 5.0 0.0 0.2 host 0.2\n"
      "ODOM 5.04 5 0 0.3 0 0 0.3 host 0.3\n"
      "FLASER 2 1.0 2.0 5.05 5.2 1.5707963 5.05 5.0 1.5707963 0.9 host 0.9\n",
      &T_base_scanner);
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_FALSE(readings[0].reference || readings[1].reference) << "it is all odometry";
  EXPECT_NEAR((readings[0].odometry.position - Eigen::Vector2d(0.02, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((readings[1].odometry.position - Eigen::Vector2d(0.05, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(readings[1].odometry.yaw_rad, M_PI / 2.0, 1e-6);
  EXPECT_NEAR((T_base_scanner.position - Eigen::Vector2d(0.2, 0.0)).norm(), 0.0, 1e-6);
}

TEST(CarmenLog, TakesTheLasersPoseAsTheReferenceWhereItIsNoOdometry) {
  const auto readings = readingsOf(
      "PARAM robot_frontlaser_offset 0.2 nohost 0\n"
      "FLASER 2 1.0 2.0 3.2 0.0 0.0 0.0 0.0 0.0 0.2 host 0.2\n"
      "FLASER 2 1.0 2.0 4.1 0.2 1.5707963 1.0 0.0 1.4 2.2 host 2.2\n");
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_NEAR((readings[0].reference->position - Eigen::Vector2d(3.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((readings[1].reference->position - Eigen::Vector2d(4.1, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((readings[1].odometry.position - Eigen::Vector2d(1.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(readings[1].odometry.yaw_rad, 1.4, 1e-9);
}

TEST(CarmenLog, ReadsScansOfItsNewerForm) {
  const auto readings = readingsOf(
      "ROBOTLASER1 0 -2.0 4.0 0.5 30.0 0.01 0 3 1.0 30.0 2.5 1 77 1 2 0.1 1 2 0.1 "
      "0 0 0.5 0.5 9 0.25 host 0.25\n");
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].stamp_s, 0.25);
  ASSERT_EQ(readings[0].scan.ranges_m.size(), 3U);
  EXPECT_NEAR(readings[0].scan.angle(2), -1.0, 1e-12);
  EXPECT_EQ(readings[0].scan.ranges_m[2], 2.5F);
  EXPECT_TRUE(std::isinf(readings[0].scan.ranges_m[1])) << "30 m is as far as it sees";
  EXPECT_NEAR(readings[0].reference->position.y(), 2.0, 1e-12);
}

TEST(CarmenLog, ReadsItCompressedToo) {
  const test::TempFolder folder;
  const std::string file = (folder / "small.log.gz").string();
  gzFile out = gzopen(file.c_str(), "wb");
  gzputs(out, kSmallLog);
  gzclose(out);
  LaserReading reading;
  {
    const auto log = openLaserLog(file);
    EXPECT_TRUE(log->next(reading) && log->next(reading) && !log->next(reading));
  }
  test::truncateBy(file, 12);
  const auto log = openLaserLog(file);
  const std::string message = test::messageOf([&] {
    while (log->next(reading)) continue;
  });
  EXPECT_NE(message.find("small.log.gz"), std::string::npos) << message;
}

TEST(CarmenLog, SaysWhichLineIsBroken) {
  const test::TempFolder folder;
  for (const char* line : {"FLASER 4 1.0 2.0 x 3.5 1 0 0 1 0 0 1 host 1\n", "FLASER 4 1.0\n",
                           "FLASER 99999999 1.0\n", "FLASER -1 1.0\n", "ODOM 1 nan 0\n",
                           "ROBOTLASER1 0 -1 2 0.5 30 0 0 2 1 1 1e300 1 0 0 1 0 0\n"}) {
    const auto log = openLaserLog(folder.write("bad.log", std::string("# one\n") + line));
    LaserReading reading;
    const std::string message = test::messageOf([&] { log->next(reading); });
    EXPECT_NE(message.find("bad.log:2:"), std::string::npos) << line << message;
  }
  EXPECT_NE(test::messageOf([&] { openLaserLog(folder / "none.log"); }), "");
}

TEST(CarmenLog, EndsAtALineThatDoesNotEnd) {
  const test::TempFolder folder;
  for (const char byte : {'1', ' ', '\0'}) {
    const auto log = openLaserLog(folder.write("long.log", std::string(5000000, byte)));
    LaserReading reading;
    const std::string message = test::messageOf([&] { log->next(reading); });
    EXPECT_NE(message.find("long.log:1: this is no line of a log"), std::string::npos) << message;
  }
  EXPECT_NE(test::messageOf([] { openLaserLog("/dev/zero"); }).find("not a file"),
            std::string::npos);
}

TEST(CarmenLog, HasTheRawOdometryOfARealDrive) {
  HEEL_NEED_DATA("laser_logs/freiburg-079.log.gz");
  const auto log = openLaserLog(test::dataFolder() / "laser_logs/freiburg-079.log.gz");
  LaserReading reading;
  int scans = 0;
  while (log->next(reading)) ++scans;
  EXPECT_EQ(scans, 4791);
  // The raw odometry ends 45.6 m off the corrected one, which starts 1.6 mm from 0.
  EXPECT_NEAR((reading.odometry.position - reading.reference->position).norm(), 45.6, 0.1);
}

TEST(SimulatedLaserLog, PutsScansOdometryAndTruthTogetherByTime) {
  const test::TempFolder folder;
  folder.write("scan.csv",
               "stamp_s,first_rad,step_rad,ranges_m\n0.0,-1,0.5,1,inf,2\n0.2,-1,0.5,1,1,nan\n");
  folder.write("odometry.csv",
               "stamp_s,x_m,y_m,yaw_rad\n0.0,0,0,0\n0.1,0.1,0,0\n0.2,0.2,0,0\n0.3,9,0,0\n");
  folder.write("robot.csv", "stamp_s,x_m,y_m,yaw_rad,forward_mps\n0.0,5,5,1,0\n0.15,5.1,5,1,0\n");
  const auto log = openLaserLog(folder.path());
  LaserReading reading;
  ASSERT_TRUE(log->next(reading));
  EXPECT_TRUE(std::isinf(reading.scan.ranges_m[1]));
  EXPECT_EQ(reading.odometry.position.x(), 0.0);
  ASSERT_TRUE(log->next(reading));
  EXPECT_TRUE(std::isnan(reading.scan.ranges_m[2]));
  EXPECT_EQ(reading.odometry.position.x(), 0.2);
  EXPECT_EQ(reading.reference->position.x(), 5.1);
  EXPECT_FALSE(log->next(reading));
}

TEST(SimulatedLaserLog, NeedsNoTruth) {
  const test::TempFolder folder;
  folder.write("scan.csv", "stamp_s,first_rad,step_rad,ranges_m\n0.1,-1,0.5,1\n");
  folder.write("odometry.csv", "stamp_s,x_m,y_m,yaw_rad\n0.1,0.3,0,0\n");
  LaserReading reading;
  ASSERT_TRUE(openLaserLog(folder.path())->next(reading));
  EXPECT_EQ(reading.odometry.position.x(), 0.3);
  EXPECT_FALSE(reading.reference);
}

TEST(SimulatedLaserLog, SaysWhichFileIsMissingOrBroken) {
  const test::TempFolder folder;
  EXPECT_NE(test::messageOf([&] { openLaserLog(folder.path()); }).find("scan.csv"),
            std::string::npos);
  folder.write("scan.csv", "");
  EXPECT_NE(
      test::messageOf([&] { openLaserLog(folder.path()); }).find("scan.csv: the file is empty"),
      std::string::npos);
  folder.write("scan.csv", "stamp_s,first_rad,step_rad,ranges_m\n0.0,-1,x\n");
  EXPECT_NE(test::messageOf([&] { openLaserLog(folder.path()); }).find("odometry.csv"),
            std::string::npos);
  folder.write("odometry.csv", "stamp_s,x_m,y_m,yaw_rad\n");
  folder.write("robot.csv", "stamp_s,x_m,y_m,yaw_rad\n");
  const auto log = openLaserLog(folder.path());
  LaserReading reading;
  EXPECT_NE(test::messageOf([&] { log->next(reading); }).find("scan.csv:2:"), std::string::npos);
}

}  // namespace
}  // namespace heel
