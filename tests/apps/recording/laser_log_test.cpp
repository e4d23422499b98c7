// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/laser_log.hpp>

#include <gmock/gmock.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <limits>
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

// Bug: one such jump made it a corrected log, of which nothing but the scans' poses was read.
TEST(CarmenLog, OneJumpOfTheOdometryIsNoCorrection) {
  const auto readings = readingsOf(
      "ODOM 0 0 0 0.3 0 0 0.1 host 0.1\n"
      "FLASER 2 2.0 2.0 0.02 0.0 0.0 0.02 0.0 0.0 0.2 host 0.2\n"
      "ODOM 0.03 0 0 0.3 0 0 0.3 host 0.3\n"
      "FLASER 2 2.0 2.0 1.09 0.0 0.0 1.09 0.0 0.0 0.4 host 0.4\n"
      "ODOM 1.1 0 0 0.3 0 0 0.5 host 0.5\n"
      "FLASER 2 2.0 2.0 1.12 0.0 0.0 1.12 0.0 0.0 0.6 host 0.6\n");
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_FALSE(readings[1].reference);
  EXPECT_NEAR(readings[2].odometry.position.x(), 1.12, 1e-9);
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

// Bug: CARMEN can log each scan in both forms; each was counted twice.
TEST(CarmenLog, ReadsEachScanOnceOfALogThatHasBothForms) {
  const auto readings = readingsOf(
      "FLASER 2 1.0 2.0 1 2 0.1 1 2 0.1 0.25 host 0.25\n"
      "ROBOTLASER1 0 -1.57 3.14 3.14 30.0 0.01 0 2 1.0 2.0 0 1 2 0.1 1 2 0.1 "
      "0 0 0.5 0.5 9 0.25 host 0.25\n"
      "FLASER 2 1.5 2.0 1 2 0.1 1 2 0.1 0.50 host 0.50\n");
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_EQ(readings[1].scan.ranges_m[0], 1.5F);
}

TEST(CarmenLog, ABrokenScanOfTheOneFormDoesNotHideThoseOfTheOther) {
  EXPECT_EQ(readingsOf("FLASER 2 1.0 broken\n"
                       "ROBOTLASER1 0 -1.57 3.14 3.14 30.0 0.01 0 2 1.0 2.0 0 1 2 0.1 1 2 0.1 "
                       "0 0 0.5 0.5 9 0.25 host 0.25\n")
                .size(),
            1U);
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
  out = gzopen(file.c_str(), "wb0");  // stored, so that a half has half the scans
  for (int i = 0; i < 100; ++i) gzputs(out, kSmallLog);
  gzclose(out);
  test::truncateBy(file, std::filesystem::file_size(file) / 2);
  const auto log = openLaserLog(file);
  int scans = 0;
  while (log->next(reading)) ++scans;
  EXPECT_GT(scans, 0);
  EXPECT_NE(log->lost().find("small.log.gz"), std::string::npos) << log->lost();
}

TEST(CarmenLog, LeavesOutWhatIsBrokenAndSaysSo) {
  const test::TempFolder folder;
  const std::string good = "FLASER 4 1 2 81.9 3.5 1 0 0 1 0 0 0.2 h 0.2\n";
  const auto log = openLaserLog(
      folder.write("cut.log", good + "FLASER 0 1 0 0 1 0 0 0.3 h 0.3\n" + good + "ODOM nan 0 0\n" +
                                  "FLASER 4 inf 2 nan 3.5 1 0 0 1 0 0 0.4 h 0.4\nFLASER 4 1.0 2"));
  LaserReading reading;
  for (int scan = 0; scan < 3; ++scan) ASSERT_TRUE(log->next(reading));
  EXPECT_TRUE(std::isinf(reading.scan.ranges_m[0]));
  EXPECT_TRUE(std::isinf(reading.scan.ranges_m[2]));
  EXPECT_FALSE(log->next(reading));
  EXPECT_NE(log->lost().find("cut.log:2: a scan must have"), std::string::npos) << log->lost();
  EXPECT_NE(log->lost().find("3 lines"), std::string::npos) << log->lost();
}

TEST(CarmenLog, SaysWhichLineIsBrokenWhereNoScanIsWhole) {
  const test::TempFolder folder;
  for (const char* line : {"FLASER 4 1.0 2.0 x 3.5 1 0 0 1 0 0 1 host 1\n", "FLASER 4 1.0\n",
                           "FLASER 99999999 1.0\n", "FLASER -1 1.0\n", "ODOM 1 nan 0\n",
                           "ROBOTLASER1 0 -1 2 0.5 30 0 0 2 1 1 1e300 1 0 0 1 0 0\n"}) {
    const auto file = folder.write("bad.log", std::string("# one\n") + line);
    const std::string message = test::messageOf([&] { openLaserLog(file); });
    EXPECT_NE(message.find("bad.log:2:"), std::string::npos) << line << message;
  }
  EXPECT_NE(test::messageOf([&] { openLaserLog(folder / "none.log"); }), "");
}

TEST(CarmenLog, EndsAtALineThatDoesNotEnd) {
  const test::TempFolder folder;
  for (const char byte : {'1', ' ', '\0'}) {
    const auto file = folder.write("long.log", std::string(5000000, byte));
    const std::string message = test::messageOf([&] { openLaserLog(file); });
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

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

LaserScanMsg scanOf(double first_rad, double step_rad, const std::vector<float>& ranges) {
  LaserScanMsg scan;
  scan.header.stamp.ns = 200'000'000;
  scan.header.frame_id = "laser";
  scan.angle_min = static_cast<float>(first_rad);
  scan.angle_increment = static_cast<float>(step_rad);
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = ranges;
  return scan;
}

/// A bag of one scan, of a laser that tf puts on a frame by a turn.
class LaserBag {
 public:
  explicit LaserBag(const LaserScanMsg& scan, const Eigen::Quaterniond& turn = upright(),
                    const std::string& parent = "base_link") {
    TFMessageMsg transforms;
    TransformStampedMsg laser;
    laser.header.frame_id = parent;
    laser.child_frame_id = "laser";
    laser.transform.translation.x = 0.1;
    laser.transform.translation.z = 0.3;
    laser.transform.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
    transforms.transforms = {laser};
    const auto bag = createBag(path_);
    if (!parent.empty()) bag->write("/tf_static", 100'000'000, transforms, true);
    OdometryMsg odometry;
    odometry.header.stamp.ns = 100'000'000;
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    odometry.pose.pose.orientation.w = 1.0;
    bag->write("/odom", 100'000'000, odometry);
    bag->write("/scan", 200'000'000, scan);
    bag->commit();
    log_ = openLaserLog(path_);
  }
  static Eigen::Quaterniond upright() { return Eigen::Quaterniond::Identity(); }

  const LaserLog& log() const { return *log_; }
  LaserScan scan() {
    LaserReading reading;
    EXPECT_TRUE(log_->next(reading));
    return reading.scan;
  }

 private:
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "r.bag";
  std::unique_ptr<LaserLog> log_;
};

/// The range of the beam that points nearest to a direction of the base frame.
float rangeTowards(const LaserScan& scan, const FloorPose& T_base_scanner, double bearing_rad) {
  std::size_t nearest = 0;
  const auto off = [&](std::size_t i) {
    return std::abs(wrapped(T_base_scanner.yaw_rad + scan.angle(i) - bearing_rad));
  };
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
    nearest = off(i) < off(nearest) ? i : nearest;
  EXPECT_LT(off(nearest), 1e-6);
  return scan.ranges_m[nearest];
}

TEST(BagLaserLog, AScannerUpsideDownSeesWhatIsOnTheLeftOnTheLeft) {
  const LaserScanMsg message = scanOf(-0.5, 0.5, {1.0F, 2.0F, 3.0F});
  const Eigen::Quaterniond rolled(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond yawed(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  LaserBag bag(message, yawed * rolled);
  const FloorPose place = *bag.log().T_base_scanner();
  EXPECT_NEAR(place.yaw_rad, 0.7, 1e-9);
  EXPECT_THAT(bag.log().warnings(), testing::IsEmpty());
  const LaserScan scan = bag.scan();
  // Its first beam is 0.5 to the right of its X as it sees it: that is to the left of the robot.
  EXPECT_EQ(rangeTowards(scan, place, 0.7 + 0.5), 1.0F);
  EXPECT_EQ(rangeTowards(scan, place, 0.7), 2.0F);
  EXPECT_EQ(rangeTowards(scan, place, 0.7 - 0.5), 3.0F);
  // By pitch it comes to the same, and then it looks back.
  LaserBag pitched(message, Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY())));
  const FloorPose back = *pitched.log().T_base_scanner();
  EXPECT_EQ(rangeTowards(pitched.scan(), back, M_PI + 0.5), 1.0F);
}

TEST(BagLaserLog, WarnsOfALaserThatIsTilted) {
  const auto pitched = [](double rad) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()));
  };
  const LaserScanMsg message = scanOf(-0.5, 0.5, {1.0F, 2.0F, 3.0F});
  EXPECT_THAT(LaserBag(message, pitched(0.4)).log().warnings(), testing::IsEmpty());
  EXPECT_THAT(LaserBag(message, pitched(0.5)).log().warnings(),
              testing::ElementsAre(testing::HasSubstr("'laser' is tilted by 29 degrees")));
}

TEST(BagLaserLog, BeamsThatTurnToTheRightAreTurnedRound) {
  const LaserScan scan = LaserBag(scanOf(1.0, -0.5, {1.0F, 2.0F, 3.0F})).scan();
  EXPECT_NEAR(scan.first_rad, 0.0, 1e-6);
  EXPECT_NEAR(scan.step_rad, 0.5, 1e-6);
  EXPECT_THAT(scan.ranges_m, testing::ElementsAre(3.0F, 2.0F, 1.0F));
}

TEST(BagLaserLog, AFullCircleFromZeroOnBeginsBehind) {
  const LaserScan scan = LaserBag(scanOf(0.0, M_PI / 2.0, {1.0F, 2.0F, 3.0F, 4.0F})).scan();
  EXPECT_NEAR(scan.first_rad, -M_PI, 1e-6);
  EXPECT_THAT(scan.ranges_m, testing::ElementsAre(3.0F, 4.0F, 1.0F, 2.0F));
  // One that has both ends of the circle has one of them twice.
  EXPECT_THAT(LaserBag(scanOf(0.0, M_PI / 2.0, {1.0F, 2.0F, 3.0F, 4.0F, 9.0F})).scan().ranges_m,
              testing::ElementsAre(3.0F, 4.0F, 1.0F, 2.0F));
  // One that begins behind already is as it was, though pi is rounded up as a float.
  const LaserScan behind = LaserBag(scanOf(-M_PI, M_PI / 2.0, {1.0F, 2.0F, 3.0F})).scan();
  EXPECT_NEAR(behind.first_rad, -M_PI, 1e-6);
  EXPECT_THAT(behind.ranges_m, testing::ElementsAre(1.0F, 2.0F, 3.0F));
}

TEST(BagLaserLog, PartOfACircleThatGoesOnBehindHasAGap) {
  const LaserScan scan =
      LaserBag(scanOf(M_PI / 2.0, M_PI / 4.0, {1.0F, 2.0F, 3.0F, 4.0F, 5.0F})).scan();
  EXPECT_NEAR(scan.first_rad, -M_PI, 1e-6);
  const auto gap = testing::IsNan();
  EXPECT_THAT(scan.ranges_m, testing::ElementsAre(3.0F, 4.0F, 5.0F, gap, gap, gap, 1.0F, 2.0F));
}

TEST(BagLaserLog, LeavesAnglesThatCanNotBeToTheReader) {
  for (const double step : {1e-12, 0.0, std::nan("")}) {
    EXPECT_EQ(LaserBag(scanOf(M_PI, step, {1.0F, 2.0F})).scan().ranges_m.size(), 2U) << step;
  }
  EXPECT_TRUE(std::isnan(LaserBag(scanOf(std::nan(""), 0.1, {1.0F})).scan().first_rad));
}

TEST(BagLaserLog, WhatCouldNotBeMeasuredIsNotFree) {
  LaserScanMsg message =
      scanOf(0.0, 0.1, {kNaN, -kInf, 0.0F, 0.05F, 0.1F, 9.9F, 10.0F, 12.0F, kInf});
  const auto unknown = testing::IsNan();
  EXPECT_THAT(LaserBag(message).scan().ranges_m,
              testing::ElementsAre(unknown, unknown, kInf, unknown, 0.1F, 9.9F, kInf, kInf, kInf));
  message.range_max = 0.0F;  // not set
  EXPECT_THAT(
      LaserBag(message).scan().ranges_m,
      testing::ElementsAre(unknown, unknown, kInf, unknown, 0.1F, 9.9F, 10.0F, 12.0F, kInf));
}

TEST(BagLaserLog, SaysWhyItDoesNotKnowWhereTheLaserIs) {
  const LaserScanMsg message = scanOf(0.0, 0.1, {1.0F, 2.0F});
  EXPECT_EQ(LaserBag(message).log().unplaced(), "");
  const LaserBag other(message, LaserBag::upright(), "chassis_link");
  EXPECT_FALSE(other.log().T_base_scanner());
  EXPECT_THAT(other.log().unplaced(),
              testing::EndsWith("r.bag: tf does not join 'laser' to base_footprint or base_link "
                                "(its root is 'chassis_link'): use --base-frame or --scanner"));
  EXPECT_THAT(LaserBag(message, LaserBag::upright(), "").log().unplaced(),
              testing::HasSubstr("(its root is 'laser')"));
}

/// What a bag with these topics of odometry, each at a place of its own, is read to be at.
class OdometryBag {
 public:
  explicit OdometryBag(const std::vector<std::string>& names) {
    const auto bag = createBag(path_);
    OdometryMsg odometry;
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_link";
    for (const std::string& name : names) {
      odometry.pose.pose.position.x += 1.0;
      bag->write(name, 100'000'000, odometry);
    }
    for (const char* scan : {"/rear/scan", "/scan_front"}) {
      bag->write(scan, 200'000'000, scanOf(0.0, 0.1, {1.0F}));
    }
    bag->commit();
  }
  std::unique_ptr<LaserLog> open(const BagTopics& topics = {}) const {
    return openLaserLog(path_, topics);
  }
  double x_m(const BagTopics& topics = {}) const {
    LaserReading reading;
    EXPECT_TRUE(open(topics)->next(reading));
    return reading.odometry.position.x();
  }

 private:
  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "r.bag";
};

TEST(BagLaserLog, OfSeveralOdometriesThatOfTheWheelsIsRead) {
  EXPECT_EQ(OdometryBag({"/gps/odom", "/robot/odom", "/odom"}).x_m(), 3.0);
  EXPECT_EQ(OdometryBag({"/wheels", "/odometry/filtered", "/robot/odom"}).x_m(), 3.0);
  EXPECT_EQ(OdometryBag({"/wheels", "/odometry/filtered", "/vo"}).x_m(), 2.0);
  EXPECT_EQ(OdometryBag({"/rtabmap/odom", "/camera/odom", "/visual_odom", "/zed/vo/odom", "/drive"})
                .x_m(),
            5.0);
  EXPECT_EQ(OdometryBag({"/rtabmap/odom"}).x_m(), 1.0);
  BagTopics named;
  named.odometry = "/gps/odom";
  EXPECT_EQ(OdometryBag({"/odom", "/gps/odom"}).x_m(named), 2.0);
}

// Bug: a scanner whose clock began with the robot's start was given odometry that was 20 s old.
TEST(BagLaserLog, AScanOfAnotherClockGoesWithTheOdometryThatCameLast) {
  const test::TempFolder folder;
  const auto bag = createBag(folder / "r.bag");
  OdometryMsg odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  odometry.pose.pose.orientation.w = 1.0;
  for (int i = 1; i < 10; ++i) {
    odometry.pose.pose.position.x = i;
    odometry.header.stamp.ns = 5'000'000'000'000 + i * 100'000'000;
    bag->write("/odom", odometry.header.stamp.ns, odometry);
  }
  bag->write("/scan", odometry.header.stamp.ns, scanOf(0.0, 0.1, {1.0F}));  // stamped 0.2 s
  bag->commit();
  LaserReading reading;
  EXPECT_TRUE(openLaserLog(folder / "r.bag")->next(reading));
  EXPECT_EQ(reading.odometry.position.x(), 9.0);
}

TEST(BagLaserLog, APoseThatIsNoNumberIsLeftOut) {
  const test::TempFolder folder;
  const auto bag = createBag(folder / "r.bag");
  OdometryMsg odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  odometry.pose.pose.orientation.w = 1.0;
  for (const double x_m : {3.0, std::nan("")}) {
    odometry.pose.pose.position.x = x_m;
    odometry.header.stamp.ns += 50'000'000;
    bag->write("/odom", odometry.header.stamp.ns, odometry);
  }
  bag->write("/scan", 200'000'000, scanOf(0.0, 0.1, {1.0F}));
  bag->commit();
  LaserReading reading;
  EXPECT_TRUE(openLaserLog(folder / "r.bag")->next(reading));
  EXPECT_EQ(reading.odometry.position.x(), 3.0);
}

TEST(BagLaserLog, SaysWhichOfSeveralTopicsIsRead) {
  const OdometryBag bag({"/gps/odom", "/odom", "/vo"});
  EXPECT_THAT(
      bag.open()->warnings(),
      testing::ElementsAre(
          testing::EndsWith("r.bag: there are several topics of laser scans; what is read is "
                            "/scan_front, not /rear/scan (--scan-topic reads another)"),
          testing::EndsWith("there are several topics of odometry; what is read is /odom, not "
                            "/gps/odom and 1 more (--odometry-topic reads another)")));
  BagTopics named;
  named.odometry = "/odom";
  named.scan = "/rear/scan";
  EXPECT_THAT(bag.open(named)->warnings(), testing::IsEmpty());
}

}  // namespace
}  // namespace heel
