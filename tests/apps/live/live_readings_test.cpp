// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/live/live_readings.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/cloud/ground_plane.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include <memory>

namespace heel {
namespace {

using testing::HasSubstr;

/// Hands on what it is given, as a network does.
class PassingOn final : public BagWriter {
 public:
  using Take = std::function<void(const BagTopic&, std::int64_t, const std::vector<std::uint8_t>&)>;
  explicit PassingOn(Take take) : take_(std::move(take)) {}
  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool) override {}

 private:
  void add(std::size_t) override {}
  void put(std::size_t topic, std::int64_t stamp_ns,
           const std::vector<std::uint8_t>& bytes) override {
    take_({topics_[topic].name, topics_[topic].type, {}}, stamp_ns, bytes);
  }
  Take take_;
};

RecordingInfo stereoCamera() {
  RecordingInfo info;
  info.sensor = SensorKind::kStereo;
  info.camera.left = {8, 6, 10.0, 10.0, 3.5, 2.5};
  info.camera.baseline_m = 0.1;
  info.T_base_camera = baseFromCamera({1.2, 0.1, 0.0});
  return info;
}

/// Odometry at 20 Hz, scans and pictures at 10 Hz, by a robot whose clock counts from `epoch_s`.
class Robot {
 public:
  explicit Robot(PassingOn::Take take, double epoch_s = 1000.0)
      : bag_(std::make_unique<PassingOn>(std::move(take)), stereoCamera(), false),
        epoch_s_(epoch_s) {
    bag_.setScanner(Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.0, 0.3)), 8.0F);
  }

  void measure(int tick) {
    const double stamp_s = epoch_s_ + 0.05 * tick;
    bag_.addOdometry(stamp_s, {{0.01 * tick, 0.0}, 0.0});
    if (tick % 2 != 0) return;
    LaserScan scan;
    scan.first_rad = -1.0;
    scan.step_rad = 1.0;
    scan.ranges_m = {1.0F, 2.0F + 0.01F * static_cast<float>(tick), 3.0F};
    bag_.add(stamp_s, scan);
    Frame frame;
    frame.stamp_s = stamp_s;
    frame.image_bgr = cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(tick));
    frame.right_bgr = cv::Mat(6, 8, CV_8UC3, cv::Scalar::all(tick + 100));
    bag_.add(frame);
    bag_.addFloor(stamp_s, cv::Mat(3, 4, CV_32FC1, cv::Scalar(0.01 * tick)));
  }

 private:
  SensorBag bag_;
  double epoch_s_;
};

/// Readings of a robot that was heard for a second.
std::unique_ptr<LiveReadings> begin() {
  FedBagReader messages(BagForm::kRos2);
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) { messages.feed(t, ns, b); });
  for (int tick = 0; tick < 20; ++tick) robot.measure(tick);
  BagTopics topics;
  topics.floor = "/floor_camera/depth/image_rect";
  return std::make_unique<LiveReadings>(surveyMessages(messages, "the network"), topics);
}

TEST(LiveReadings, GivesTheNewestOfEachSensorOnce) {
  const auto readings = begin();
  double clock_s = 50.0;
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) {
    readings->take(t, ns, b, clock_s);
  });
  for (int tick = 20; tick <= 22; ++tick) robot.measure(tick);
  const RobotReadings& now = readings->read(clock_s);
  ASSERT_NE(now.frame, nullptr);
  EXPECT_NEAR(now.frame->stamp_s, 1001.1, 1e-9);
  EXPECT_EQ(now.frame->image_bgr.at<cv::Vec3b>(0, 0)[0], 22);
  EXPECT_EQ(now.frame->right_bgr.at<cv::Vec3b>(0, 0)[0], 122);
  EXPECT_EQ(readings->framesLeftOut(), 1U);
  ASSERT_NE(now.scan, nullptr);
  EXPECT_FLOAT_EQ(now.scan->ranges_m[1], 2.22F);
  EXPECT_NEAR(*now.scan_stamp_s, 1001.1, 1e-9);
  EXPECT_NEAR(now.odometry->position.x(), 0.22, 1e-9);
  EXPECT_NEAR(*now.odometry_stamp_s, 1001.1, 1e-9);
  ASSERT_NE(now.floor, nullptr);
  EXPECT_FLOAT_EQ(now.floor->depth_m.at<float>(0, 0), 0.22F);
  EXPECT_NEAR(now.floor->stamp_s, 1001.1, 1e-9);
  EXPECT_EQ(readings->odometryFrame(), "odom");
  const RobotReadings& then = readings->read(clock_s);
  EXPECT_EQ(then.frame, nullptr);
  EXPECT_EQ(then.floor, nullptr);
  EXPECT_EQ(then.scan, nullptr);
  EXPECT_FALSE(then.odometry);
}

TEST(LiveReadings, TellsWhereTheSensorsAre) {
  const auto readings = begin();
  EXPECT_TRUE(readings->info().T_base_camera->isApprox(*stereoCamera().T_base_camera));
  EXPECT_NEAR(readings->laser().T_base_scanner()->position.x(), 0.2, 1e-9);
  EXPECT_NEAR(*readings->laser().scannerHeight_m(), 0.3, 1e-9);
}

TEST(LiveReadings, AFrameIsThereWhenItsSecondPictureHasCome) {
  const auto readings = begin();
  std::vector<std::pair<std::string, bool>> told;
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) {
    const bool has_frame = readings->take(t, ns, b, 1.0);
    if (t.name.rfind("/camera/", 0) == 0 && t.type == ImageMsg::kType) {
      told.emplace_back(t.name, has_frame);
    }
  });
  robot.measure(20);
  EXPECT_THAT(told, testing::ElementsAre(testing::Pair(HasSubstr("left"), false),
                                         testing::Pair(HasSubstr("right"), true)));
}

TEST(LiveReadings, TimeIsTheNewestStampAndWhatHasPassedSinceAndNeverGoesBack) {
  const auto readings = begin();
  double clock_s = 50.0;
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) {
    readings->take(t, ns, b, clock_s);
  });
  robot.measure(20);
  EXPECT_NEAR(readings->read(clock_s).stamp_s, 1001.0, 1e-9);
  EXPECT_NEAR(readings->read(clock_s + 0.3).stamp_s, 1001.3, 1e-9);
  clock_s = 51.0;
  robot.measure(22);  // Late, or slower than our clock.
  EXPECT_NEAR(readings->read(clock_s).stamp_s, 1001.3, 1e-9);
  EXPECT_NEAR(readings->read(clock_s + 0.3).stamp_s, 1001.4, 1e-9);
}

TEST(LiveReadings, TimeThatGoesBackForGoodGoesOnFromThere) {
  const auto readings = begin();
  const auto take = [&](const BagTopic& t, std::int64_t ns, const auto& b) {
    readings->take(t, ns, b, 50.0);
  };
  Robot before(take), reset(take, 0.0);
  before.measure(20);
  EXPECT_NE(readings->read(50.0).frame, nullptr);
  EXPECT_FALSE(readings->hasBegunAnew());
  for (int tick = 2; tick <= 8; tick += 2) reset.measure(tick);
  EXPECT_EQ(readings->read(50.0).frame, nullptr) << "four may be late";
  EXPECT_GT(readings->read(50.0).stamp_s, 1000.9);
  reset.measure(10);
  reset.measure(12);
  const RobotReadings& now = readings->read(50.0);
  EXPECT_TRUE(readings->hasBegunAnew());
  ASSERT_NE(now.frame, nullptr);
  EXPECT_NEAR(now.frame->stamp_s, 0.6, 1e-9);
  EXPECT_EQ(now.frame->right_bgr.at<cv::Vec3b>(0, 0)[0], 112);
  EXPECT_NEAR(now.stamp_s, 0.6, 1e-9);
  EXPECT_NEAR(now.odometry->position.x(), 0.12, 1e-9);
  reset.measure(14);
  EXPECT_NEAR(readings->read(50.0).stamp_s, 0.7, 1e-9);
  EXPECT_FALSE(readings->hasBegunAnew());
}

TEST(LiveReadings, FramesThatAreLateNowAndThenDoNotTurnTimeBack) {
  const auto readings = begin();
  Robot robot(
      [&](const BagTopic& t, std::int64_t ns, const auto& b) { readings->take(t, ns, b, 50.0); });
  for (const int tick : {40, 22, 24, 26, 28, 42, 30, 32, 34, 36, 44, 30, 28, 26, 24, 22, 20}) {
    robot.measure(tick);
  }
  EXPECT_NEAR(readings->read(50.0).stamp_s, 1002.2, 1e-9);
  EXPECT_FALSE(readings->hasBegunAnew());
}

TEST(LiveReadings, AnImageOfTheFloorThatCanNotBeReadIsSkippedAndCounted) {
  const auto readings = begin();
  Robot robot([&](const BagTopic& t, std::int64_t ns, auto bytes) {
    if (t.name.rfind("/floor_camera/", 0) == 0) bytes.resize(bytes.size() / 2);
    readings->take(t, ns, bytes, 1.0);
  });
  robot.measure(20);
  EXPECT_EQ(readings->read(1.0).floor, nullptr);
  const auto skipped = readings->skipped();
  ASSERT_EQ(skipped.size(), 1U);
  EXPECT_THAT(skipped.front().reason, testing::StartsWith("/floor_camera/depth/image_rect: "));
}

TEST(LiveReadings, APictureWithoutItsPartnerIsLeftOut) {
  const auto readings = begin();
  bool drops = true;
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) {
    const bool is_right = t.name.find("right") != std::string::npos && t.type == ImageMsg::kType;
    if (!(drops && is_right)) readings->take(t, ns, b, 1.0);
  });
  robot.measure(20);
  EXPECT_EQ(readings->read(1.0).frame, nullptr);
  drops = false;
  robot.measure(22);
  const RobotReadings& now = readings->read(1.1);
  ASSERT_NE(now.frame, nullptr);
  EXPECT_NEAR(now.frame->stamp_s, 1001.1, 1e-9);
}

TEST(LiveReadings, SaysWhatIsMissing) {
  FedBagReader messages(BagForm::kRos2);
  Robot robot([&](const BagTopic& t, std::int64_t ns, const auto& b) {
    if (t.name != "/scan") messages.feed(t, ns, b);
  });
  for (int tick = 0; tick < 20; ++tick) robot.measure(tick);
  try {
    LiveReadings readings(surveyMessages(messages, "the network"), BagTopics());
    FAIL() << "there are no scans";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the network has no laser scans"));
  }
}

}  // namespace
}  // namespace heel
