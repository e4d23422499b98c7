// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/faults.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <memory>

namespace heel {
namespace {

using Kind = Fault::Kind;

bool isSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

/// A simulator's readings at 10 Hz, made by hand: the robot goes 0.1 m a step, and the images of
/// step i have the levels 10 + i (left) and 110 + i (right). Like the simulator, it uses the same
/// memory for every image.
class Faults : public testing::Test {
 protected:
  Faults() {
    stereo_.left_bgr = cv::Mat(6, 8, CV_8UC3);
    stereo_.right_bgr = cv::Mat(6, 8, CV_8UC3);
    scan_.ranges_m = {1.0F, 2.0F};
  }

  void have(Kind kind, double from_s, double to_s) {
    sensors_ = FaultySensors({{kind, from_s, to_s}}, 7);
  }

  const RobotReadings& next() {
    truth_.stamp_s = 0.1 * steps_;
    stereo_.left_bgr.setTo(cv::Scalar::all(10 + steps_));
    stereo_.right_bgr.setTo(cv::Scalar::all(110 + steps_));
    truth_.stereo = &stereo_;
    truth_.laser = &scan_;
    floor_m_.setTo(cv::Scalar(0.1 * steps_));
    truth_.floor_depth_m = &floor_m_;
    truth_.odometry = FloorPose{{0.1 * steps_, 0.0}, 0.0};
    ++steps_;
    return sensors_.read(truth_);
  }

  /// That all of it is as the simulator has it.
  void expectTrue(const RobotReadings& read) const {
    EXPECT_EQ(read.stamp_s, truth_.stamp_s);
    expectTrueImages(read);
    expectTrueRest(read);
  }
  void expectTrueImages(const RobotReadings& read) const {
    ASSERT_NE(read.frame, nullptr);
    EXPECT_EQ(read.frame->stamp_s, read.stamp_s);
    EXPECT_TRUE(isSame(read.frame->image_bgr, stereo_.left_bgr));
    EXPECT_TRUE(isSame(read.frame->right_bgr, stereo_.right_bgr));
    EXPECT_EQ(read.pair_gap_s, 0.0);
    ASSERT_NE(read.floor, nullptr);
    EXPECT_TRUE(isSame(read.floor->depth_m, floor_m_));
  }
  void expectTrueRest(const RobotReadings& read) const {
    EXPECT_EQ(read.scan, &scan_);
    ASSERT_TRUE(read.odometry);
    EXPECT_NEAR((read.odometry->position - truth_.odometry->position).norm(), 0.0, 1e-12);
    EXPECT_EQ(read.odometry->yaw_rad, 0.0);
  }
  void expectImagesOfThisStepUnchanged() const {
    EXPECT_EQ(stereo_.left_bgr.at<cv::Vec3b>(0, 0)[0], 10 + steps_ - 1);
    EXPECT_EQ(stereo_.right_bgr.at<cv::Vec3b>(0, 0)[0], 110 + steps_ - 1);
  }

  FaultySensors sensors_{{}};
  StereoReading stereo_;
  cv::Mat floor_m_{cv::Size(8, 6), CV_32FC1};
  LaserScan scan_;
  Readings truth_;
  int steps_ = 0;
};

TEST_F(Faults, WithoutFaultsTheRobotReadsTheTruth) {
  for (std::size_t i = 1; i < 4; ++i) {
    const RobotReadings& read = next();
    expectTrue(read);
    EXPECT_EQ(read.frame->number, i);
  }
}

TEST_F(Faults, WhatTheSimulatorDidNotMeasureIsNotRead) {
  Readings nothing;
  nothing.stamp_s = 3.0;
  const RobotReadings& read = sensors_.read(nothing);
  EXPECT_EQ(read.stamp_s, 3.0);
  EXPECT_EQ(read.frame, nullptr);
  EXPECT_EQ(read.scan, nullptr);
  EXPECT_FALSE(read.odometry);
}

TEST_F(Faults, BeginAndEndAtTheirTimes) {
  have(Kind::kNoLaser, 0.1, 0.3);
  EXPECT_NE(next().scan, nullptr);
  EXPECT_EQ(next().scan, nullptr);
  EXPECT_EQ(next().scan, nullptr);
  EXPECT_NE(next().scan, nullptr);
}

TEST_F(Faults, NoCameraTakesTheImagesOnly) {
  have(Kind::kNoCamera, 0.1, 0.2);
  expectTrue(next());
  const RobotReadings& read = next();
  EXPECT_EQ(read.frame, nullptr);
  expectTrueRest(read);
  expectTrue(next());
}

TEST_F(Faults, NoLaserTakesTheScanOnly) {
  have(Kind::kNoLaser, 0.1, 0.2);
  next();
  const RobotReadings& read = next();
  EXPECT_EQ(read.scan, nullptr);
  expectTrueImages(read);
  EXPECT_TRUE(read.odometry);
  expectTrue(next());
}

TEST_F(Faults, SlippingWheelsGoAThirdTooFarAndToTheLeftFromThereOn) {
  have(Kind::kWheelsSlip, 0.15, 0.35);
  next();
  expectTrue(next());
  next();
  const FloorPose slipped = *next().odometry;  // Two steps of it.
  EXPECT_NEAR(slipped.position.x(), 0.1 + 0.2 * 4.0 / 3.0, 1e-3);
  EXPECT_NEAR(slipped.yaw_rad, 0.02, 1e-12);
  const RobotReadings& after = next();
  const FloorPose moved = slipped.inverse() * *after.odometry;
  EXPECT_NEAR(moved.position.x(), 0.1, 1e-12) << "true increments, though the place stays wrong";
  EXPECT_NEAR(moved.yaw_rad, 0.0, 1e-12);
  expectTrueImages(after);
  EXPECT_EQ(after.scan, &scan_);
}

TEST_F(Faults, NoiseFillsBothImagesAnewEachTime) {
  have(Kind::kNoise, 0.1, 0.3);
  expectTrue(next());
  cv::Mat last;
  for (int i = 0; i < 2; ++i) {
    const RobotReadings& read = next();
    expectTrueRest(read);
    ASSERT_NE(read.frame, nullptr);
    EXPECT_EQ(read.frame->image_bgr.size(), stereo_.left_bgr.size());
    EXPECT_FALSE(isSame(read.frame->image_bgr, read.frame->right_bgr));
    EXPECT_FALSE(isSame(read.frame->image_bgr, stereo_.left_bgr));
    EXPECT_NEAR(cv::mean(read.frame->image_bgr)[0], 127.5, 50.0);
    EXPECT_TRUE(last.empty() || !isSame(read.frame->image_bgr, last));
    last = read.frame->image_bgr.clone();
    expectImagesOfThisStepUnchanged();
  }
  expectTrue(next());
}

TEST_F(Faults, NoiseComesFromTheSeed) {
  cv::Mat images[3];
  const std::uint64_t seeds[3] = {1, 1, 2};
  for (int i = 0; i < 3; ++i) {
    sensors_ = FaultySensors({{Kind::kNoise, 0.0, 100.0}}, seeds[i]);
    images[i] = next().frame->image_bgr.clone();
  }
  EXPECT_TRUE(isSame(images[0], images[1]));
  EXPECT_FALSE(isSame(images[0], images[2]));
}

TEST_F(Faults, WithoutLightsBothImagesAreBlack) {
  have(Kind::kLightsOut, 0.1, 0.2);
  expectTrue(next());
  const RobotReadings& read = next();
  expectTrueRest(read);
  ASSERT_NE(read.frame, nullptr);
  EXPECT_EQ(cv::norm(read.frame->image_bgr), 0.0);
  EXPECT_EQ(cv::norm(read.frame->right_bgr), 0.0);
  expectImagesOfThisStepUnchanged();
  expectTrue(next());
}

TEST_F(Faults, APairOutOfStepHasTheRightImageOfTheFrameBefore) {
  have(Kind::kPairOutOfStep, 0.1, 0.3);
  expectTrue(next());
  for (int i = 1; i < 3; ++i) {
    const RobotReadings& read = next();
    expectTrueRest(read);
    EXPECT_NEAR(read.pair_gap_s, 0.1, 1e-12);
    EXPECT_TRUE(isSame(read.frame->image_bgr, stereo_.left_bgr));
    EXPECT_EQ(read.frame->right_bgr.at<cv::Vec3b>(0, 0)[0], 110 + i - 1);
    expectImagesOfThisStepUnchanged();
  }
  expectTrue(next());
}

TEST_F(Faults, AClockThatJumpsMovesAllStampsAndNothingElse) {
  have(Kind::kClockJumps, 0.1, 0.2);
  expectTrue(next());
  const RobotReadings& read = next();
  EXPECT_NEAR(read.stamp_s, truth_.stamp_s + 3600.0, 1e-9);
  expectTrueImages(read);
  expectTrueRest(read);
  expectTrue(next());
}

TEST_F(Faults, AClockThatIsSetBackMovesAllStampsAndNothingElse) {
  have(Kind::kClockBack, 0.1, 0.2);
  expectTrue(next());
  const RobotReadings& read = next();
  EXPECT_NEAR(read.stamp_s, truth_.stamp_s - 1.5, 1e-9);
  expectTrueImages(read);
  expectTrueRest(read);
  expectTrue(next());
}

TEST_F(Faults, LateReadingsKeepTheirStampsAndTheirOrder) {
  Latencies latencies;
  latencies.camera_s = 0.25;
  latencies.laser_s = latencies.wheels_s = 0.1;
  sensors_ = FaultySensors({}, 7, latencies);
  int pictures = 0, floors = 0, scans = 0;
  double picture_s = -1.0;
  for (int i = 0; i < 20; ++i) {
    const RobotReadings& read = next();
    if (read.frame != nullptr) {
      ++pictures;
      const double age_s = read.stamp_s - read.frame->stamp_s;
      EXPECT_GE(age_s, 0.125 - 1e-6);
      EXPECT_LT(age_s, 0.25 + 0.1);
      EXPECT_GT(read.frame->stamp_s, picture_s);
      picture_s = read.frame->stamp_s;
      EXPECT_EQ(read.frame->image_bgr.at<cv::Vec3b>(0, 0)[0], 10 + std::lround(10.0 * picture_s))
          << "the picture of then";
    }
    if (read.floor != nullptr) {
      ++floors;
      const double stamp_s = read.floor->stamp_s;
      EXPECT_GE(read.stamp_s - stamp_s, 0.125 - 1e-6);
      EXPECT_NEAR(read.floor->depth_m.at<float>(0, 0), stamp_s, 1e-6) << "the image of then";
    }
    if (read.scan != nullptr) {
      ++scans;
      EXPECT_NEAR(read.stamp_s - *read.scan_stamp_s, 0.1, 1e-6) << "the next step's";
      ASSERT_TRUE(read.odometry);
      EXPECT_NEAR(read.odometry->position.x(), *read.odometry_stamp_s, 1e-9);
    }
  }
  EXPECT_GT(pictures, 10);
  EXPECT_GT(floors, 10);
  EXPECT_EQ(scans, 19);
}

TEST_F(Faults, SeveralCanBeAtOnce) {
  sensors_ = FaultySensors({{Kind::kNoLaser, 0.0, 9.0}, {Kind::kNoCamera, 0.1, 9.0}});
  EXPECT_NE(next().frame, nullptr);
  const RobotReadings& read = next();
  EXPECT_EQ(read.frame, nullptr);
  EXPECT_EQ(read.floor, nullptr);
  EXPECT_EQ(read.scan, nullptr);
  EXPECT_TRUE(read.odometry);
}

}  // namespace
}  // namespace heel
