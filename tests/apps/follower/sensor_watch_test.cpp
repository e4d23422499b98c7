// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/sensor_watch.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A robot at 10 Hz whose sensors all work, unless a test takes one away.
class SensorWatchTest : public testing::Test {
 protected:
  SensorWatchTest() { step(); }

  /// A tenth of a second later. What a test has taken away stays away.
  void step(double dt_s = 0.1) {
    readings.stamp_s += dt_s;
    frame.stamp_s = readings.stamp_s;
    readings.frame = has_frame ? &frame : nullptr;
    readings.scan = has_scan ? &scan : nullptr;
    readings.odometry.reset();
    if (has_odometry) readings.odometry = odometry;
    usable = watch.step(readings);
  }

  /// The reason after so many steps.
  std::string after(int steps) {
    for (int i = 0; i < steps; ++i) step();
    return watch.blindness();
  }

  void setBrightness(int level) { frame.image_bgr.setTo(cv::Scalar::all(level)); }

  static CameraSetup cameraOf(SensorKind sensor) {
    CameraSetup setup;
    setup.sensor = sensor;
    setup.camera.left.width = 16;
    setup.camera.left.height = 12;
    return setup;
  }

  static Frame brightFrame() {
    Frame made;
    made.image_bgr = cv::Mat(12, 16, CV_8UC3, cv::Scalar::all(100));
    made.right_bgr = made.image_bgr.clone();
    return made;
  }

  Frame frame = brightFrame();
  LaserScan scan{0.0, 0.1, {1.0F, 2.0F}};
  FloorPose odometry;
  bool has_frame = true, has_scan = true, has_odometry = true;
  RobotReadings readings, usable;
  SensorWatch watch{cameraOf(SensorKind::kStereo)};
};

TEST_F(SensorWatchTest, LetsARobotMoveWhoseSensorsWork) {
  EXPECT_EQ(after(20), "");
  EXPECT_TRUE(watch.imageIsGood());
  EXPECT_TRUE(watch.odometryIsGood());
  EXPECT_FALSE(watch.timeJumped());
}

TEST_F(SensorWatchTest, ARobotWithAFloorCameraNeedsItsImages) {
  watch = SensorWatch(cameraOf(SensorKind::kStereo), {}, cameraOf(SensorKind::kRgbd));
  Frame floor;
  floor.depth_m = cv::Mat(12, 16, CV_32FC1, cv::Scalar(1.0));
  readings.floor = &floor;
  for (int i = 0; i < 10; ++i) {
    floor.stamp_s = readings.stamp_s + 0.1;
    step();
  }
  EXPECT_EQ(watch.blindness(), "");
  EXPECT_EQ(usable.floor, &floor);
  EXPECT_NEAR(watch.floorAge_s(), 0.0, 1e-9);
  floor.depth_m = cv::Mat(12, 12, CV_32FC1, cv::Scalar(1.0));  // of another camera
  EXPECT_EQ(after(10), "no image of the floor");
  EXPECT_EQ(usable.floor, nullptr);
}

TEST_F(SensorWatchTest, TellsHowOldReadingsAreByTheirStamps) {
  after(5);
  readings.stamp_s += 0.1;
  readings.frame = &frame;
  readings.scan = &scan;
  readings.odometry = odometry;
  frame.stamp_s = readings.stamp_s - 0.2;
  readings.scan_stamp_s = readings.stamp_s - 0.05;
  readings.odometry_stamp_s = readings.stamp_s - 0.02;
  watch.step(readings);
  EXPECT_NEAR(watch.imageAge_s(), 0.2, 1e-9);
  EXPECT_NEAR(watch.scanAge_s(), 0.05, 1e-9);
  EXPECT_NEAR(watch.odometryAge_s(), 0.02, 1e-9);
  EXPECT_NEAR(watch.increment_s(), 0.08, 1e-9);
  readings.scan_stamp_s = readings.stamp_s + 50.0;  // of another clock
  readings.stamp_s += 0.1;
  watch.step(readings);
  EXPECT_EQ(watch.scanAge_s(), 0.0);
}

// Bug: what came more than a second late was taken to be of another clock, and so of now.
TEST_F(SensorWatchTest, AnImageThatComesLateIsOld) {
  for (const double late_s : {0.5, 1.5}) {
    watch = SensorWatch(cameraOf(SensorKind::kStereo));
    readings.scan = &scan;
    readings.odometry = odometry;
    readings.frame = &frame;
    for (int i = 0; i < 30; ++i) {
      readings.stamp_s += 0.1;
      frame.stamp_s = readings.stamp_s - std::min(0.1 * i, late_s);
      watch.step(readings);
    }
    EXPECT_NEAR(watch.imageAge_s(), late_s, 1e-9);
    EXPECT_EQ(watch.blindness(), late_s > 1.0 ? "no usable image" : "");
  }
}

TEST_F(SensorWatchTest, ACamerasClockMayBeAnother) {
  for (const double behind_s : {50.0, -50.0}) {
    watch = SensorWatch(cameraOf(SensorKind::kStereo));
    readings.scan = &scan;
    readings.odometry = odometry;
    readings.frame = &frame;
    for (int i = 0; i < 30; ++i) {
      readings.stamp_s += 0.1;
      frame.stamp_s = readings.stamp_s - behind_s - (i == 29 ? 0.3 : 0.0);
      watch.step(readings);
      EXPECT_EQ(watch.blindness(), "");
    }
    EXPECT_NEAR(watch.imageAge_s(), 0.3, 1e-9) << "later than before";
  }
}

TEST_F(SensorWatchTest, BearsEachSensorsSilenceForItsTime) {
  has_frame = false;
  EXPECT_EQ(after(5), "") << "0.5 s without an image";
  EXPECT_EQ(after(2), "no usable image");
  has_frame = true;
  EXPECT_EQ(after(1), "") << "the first image ends it";

  has_scan = false;
  EXPECT_EQ(after(3), "");
  EXPECT_EQ(after(1), "no laser scan");
  has_scan = true;
  EXPECT_EQ(after(1), "");

  has_odometry = false;
  EXPECT_EQ(after(3), "");
  EXPECT_FALSE(watch.odometryIsGood());
  EXPECT_EQ(after(1), "no odometry");
  has_odometry = true;
  EXPECT_EQ(after(1), "");
}

TEST_F(SensorWatchTest, SensorsThatNeverGaveAnythingAreMissedToo) {
  watch = SensorWatch(cameraOf(SensorKind::kStereo));
  has_frame = false;
  EXPECT_EQ(after(1), "");
  EXPECT_EQ(after(7), "no usable image");
}

TEST_F(SensorWatchTest, ADarkImageShowsNothing) {
  setBrightness(7);
  step();
  EXPECT_FALSE(watch.imageIsGood());
  EXPECT_EQ(watch.blindness(), "");
  EXPECT_EQ(after(6), "no usable image");
  setBrightness(8);
  EXPECT_EQ(after(1), "");
  EXPECT_TRUE(watch.imageIsGood());
}

TEST_F(SensorWatchTest, APairOutOfStepIsNotUsed) {
  for (const double gap_s : {0.021, -0.021, kNan}) {
    readings.pair_gap_s = gap_s;
    step();
    EXPECT_FALSE(watch.imageIsGood()) << gap_s;
  }
  for (const double gap_s : {0.02, -0.02, 0.0}) {
    readings.pair_gap_s = gap_s;
    step();
    EXPECT_TRUE(watch.imageIsGood()) << gap_s;
  }
}

TEST_F(SensorWatchTest, ImagesThatDoNotFitTheCameraAreNotUsed) {
  const Frame whole = brightFrame();
  const auto isGood = [this] {
    step();
    EXPECT_EQ(usable.frame != nullptr, watch.imageIsGood());
    return watch.imageIsGood();
  };
  EXPECT_TRUE(isGood());
  frame.right_bgr.release();
  EXPECT_FALSE(isGood()) << "no right image";
  frame.right_bgr = cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(100));
  EXPECT_FALSE(isGood()) << "a right image of another size";
  frame.right_bgr = cv::Mat(12, 16, CV_8UC1, cv::Scalar::all(100));
  EXPECT_FALSE(isGood()) << "a grey right image";
  frame.image_bgr = frame.right_bgr = cv::Mat(24, 32, CV_8UC3, cv::Scalar::all(100));
  EXPECT_FALSE(isGood()) << "both of a size that is not the camera's";
  frame = whole;
  frame.image_bgr.release();
  EXPECT_FALSE(isGood()) << "no left image";

  watch = SensorWatch(cameraOf(SensorKind::kRgbd));
  frame = whole;
  EXPECT_FALSE(isGood()) << "no depth";
  frame.depth_m = cv::Mat(12, 16, CV_16UC1, cv::Scalar::all(100));
  EXPECT_FALSE(isGood()) << "depth in millimetres";
  frame.depth_m = cv::Mat(12, 16, CV_32FC1, cv::Scalar::all(1));
  EXPECT_TRUE(isGood());
}

TEST_F(SensorWatchTest, AScanWithoutAReadingIsNone) {
  const auto inf = std::numeric_limits<float>::infinity();
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  for (const LaserScan& broken :
       {LaserScan{}, LaserScan{0.0, 0.1, {nan, nan}}, LaserScan{0.0, 0.1, {0.0F, -1.0F}},
        LaserScan{kNan, 0.1, {1.0F}}, LaserScan{0.0, kNan, {1.0F}}}) {
    scan = broken;
    step();
    EXPECT_FALSE(watch.scanIsGood());
    EXPECT_EQ(usable.scan, nullptr);
  }
  EXPECT_EQ(watch.blindness(), "no laser scan");
  scan = {0.0, 0.1, {nan, inf}};
  step();
  EXPECT_TRUE(watch.scanIsGood()) << "nothing is within reach on one side";
  EXPECT_EQ(usable.scan, &scan);
  EXPECT_EQ(watch.blindness(), "");
}

TEST_F(SensorWatchTest, ACloudNeedsNoImage) {
  watch = SensorWatch(cameraOf(SensorKind::kCloud));
  frame.image_bgr.release();
  step();
  EXPECT_FALSE(watch.imageIsGood());
  frame.cloud = std::make_shared<ColorCloud>();
  step();
  EXPECT_TRUE(watch.imageIsGood());
}

TEST_F(SensorWatchTest, TellsHowFarTheRobotMovedInItsOwnFrame) {
  odometry = {{2.0, 1.0}, 0.0};
  step();
  step();
  odometry = {{2.0, 1.0}, 0.3};
  step();
  EXPECT_NEAR(watch.increment().yaw_rad, 0.3, 1e-12);
  odometry.position += 0.03 * Eigen::Vector2d(std::cos(0.3), std::sin(0.3));
  step();
  EXPECT_TRUE(watch.odometryIsGood());
  EXPECT_NEAR(watch.increment().position.x(), 0.03, 1e-12);
  EXPECT_NEAR(watch.increment().position.y(), 0.0, 1e-12);
  step();
  EXPECT_EQ(watch.increment().position.norm(), 0.0);
}

TEST_F(SensorWatchTest, TakesNoIncrementFromASlipOrAReset) {
  odometry.position.x() = 0.3;  // 3 m/s
  step();
  EXPECT_FALSE(watch.odometryIsGood());
  EXPECT_EQ(watch.increment().position.norm(), 0.0);
  odometry.position.x() = 0.35;
  step();
  EXPECT_TRUE(watch.odometryIsGood()) << "it goes on from where it is now";
  EXPECT_NEAR(watch.increment().position.x(), 0.05, 1e-12);

  odometry.yaw_rad = 1.0;  // 10 rad/s
  step();
  EXPECT_FALSE(watch.odometryIsGood());
  EXPECT_EQ(watch.increment().yaw_rad, 0.0);
  step();
  EXPECT_TRUE(watch.odometryIsGood());

  odometry = {{-7.0, 4.0}, 2.0};  // A reset.
  step();
  EXPECT_FALSE(watch.odometryIsGood());
  step();
  EXPECT_TRUE(watch.odometryIsGood());
  EXPECT_EQ(watch.increment().position.norm(), 0.0);
}

TEST_F(SensorWatchTest, WheelsThatKeepSlippingLeaveItBlind) {
  for (int i = 0; i < 5; ++i) {
    odometry.position.x() = i % 2 == 0 ? 5.0 : -5.0;
    step();
  }
  EXPECT_EQ(watch.blindness(), "no odometry");
  EXPECT_EQ(after(1), "");
}

TEST_F(SensorWatchTest, OdometryThatIsNoNumberIsNone) {
  for (const FloorPose& broken : {FloorPose{{kNan, 0.0}, 0.0}, FloorPose{{0.0, 0.0}, kNan},
                                  FloorPose{{0.0, 1.0 / 0.0}, 0.0}}) {
    odometry = broken;
    step();
    EXPECT_FALSE(watch.odometryIsGood());
    EXPECT_TRUE(watch.increment().position.allFinite());
    EXPECT_TRUE(std::isfinite(watch.increment().yaw_rad));
    odometry = {{0.1, 0.0}, 0.0};
    step();
    EXPECT_TRUE(watch.odometryIsGood());
    odometry = {};
    step();
  }
}

TEST_F(SensorWatchTest, RareOdometryMayComeFurtherAtOnce) {
  has_odometry = false;
  step();
  step();
  has_odometry = true;
  odometry.position.x() = 0.4;  // In 0.3 s.
  step();
  EXPECT_TRUE(watch.odometryIsGood());
  EXPECT_NEAR(watch.increment().position.x(), 0.4, 1e-12);
  EXPECT_NEAR(watch.increment_s(), 0.3, 1e-12);
}

TEST_F(SensorWatchTest, AnIncrementIsOfTheTimeSinceTheReadingBefore) {
  odometry.position.x() = 5.0;  // a slip
  step();
  EXPECT_EQ(watch.increment_s(), 0.0);
  odometry.position.x() = 5.03;
  step();
  EXPECT_NEAR(watch.increment().position.x(), 0.03, 1e-12);
  EXPECT_NEAR(watch.increment_s(), 0.1, 1e-12) << "the slip's time is not its";
}

TEST_F(SensorWatchTest, StopsForOneStepWhereTheClockJumps) {
  for (const double jump_s : {3600.0, -3600.0, 1.5, -0.1}) {
    step(jump_s);
    EXPECT_TRUE(watch.timeJumped()) << jump_s;
    EXPECT_EQ(watch.blindness(), "the clock jumped") << jump_s;
    EXPECT_EQ(after(1), "") << jump_s;
    EXPECT_FALSE(watch.timeJumped()) << jump_s;
  }
}

TEST_F(SensorWatchTest, AJumpMakesNothingOlder) {
  has_scan = false;
  step();
  step(3600.0);
  EXPECT_EQ(watch.blindness(), "the clock jumped");
  EXPECT_EQ(after(1), "") << "0.2 s without a scan";
  EXPECT_EQ(after(2), "no laser scan");
}

TEST_F(SensorWatchTest, AStampThatIsNoNumberIsAJumpAndHidesNothing) {
  has_scan = false;
  const double stamp_s = readings.stamp_s;
  step(kNan);
  EXPECT_TRUE(watch.timeJumped());
  EXPECT_EQ(watch.blindness(), "the clock jumped");
  readings.stamp_s = stamp_s;
  step();
  EXPECT_EQ(after(4), "no laser scan");
}

TEST_F(SensorWatchTest, TellsTheTimeThatPassed) {
  EXPECT_NEAR(watch.elapsed_s(), 0.0, 0.0) << "nothing before the first step";
  step(0.25);
  EXPECT_NEAR(watch.elapsed_s(), 0.25, 1e-12);
  for (const double jump_s : {3600.0, -0.5, kNan}) {
    step(jump_s);
    EXPECT_EQ(watch.elapsed_s(), 0.0) << jump_s;
  }
}

TEST_F(SensorWatchTest, RefusesParametersThatMakeNoSense) {
  SensorWatchParams params;
  params.max_gap_s = -1.0;
  EXPECT_THROW(SensorWatch(cameraOf(SensorKind::kStereo), params), std::invalid_argument);
  params = {};
  params.max_speed_mps = kNan;
  EXPECT_THROW(SensorWatch(cameraOf(SensorKind::kStereo), params), std::invalid_argument);
}

TEST_F(SensorWatchTest, NothingPassesWhileTheClockStands) {
  has_scan = has_odometry = has_frame = false;
  for (int i = 0; i < 100; ++i) step(0.0);
  EXPECT_EQ(watch.blindness(), "");
}

}  // namespace
}  // namespace heel
