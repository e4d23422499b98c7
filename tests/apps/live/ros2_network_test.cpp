// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/filled_message.hpp"
#include <heel/apps/live/command_sender.hpp>
#include <heel/apps/live/ros2_network.hpp>

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

namespace heel {
namespace {

using test::filled;

/// Of this machine only, and of this test only.
Ros2NetworkParams ownNetwork() {
  Ros2NetworkParams params;
  params.domain = 1 + static_cast<int>(getpid() % 200);
  params.localhost_only = true;
  return params;
}

/// Waits for what comes sooner or later.
template <class Is>
bool waitFor(const Is& is) {
  for (int i = 0; i < 600; ++i) {
    if (is()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

const BagTopic kScan{"/scan", LaserScanMsg::kType, {}};

template <class Message>
std::vector<std::uint8_t> bytesOf(const Message& message) {
  std::vector<std::uint8_t> bytes;
  writeMessage(BagForm::kRos2, message, bytes);
  return bytes;
}

TEST(Ros2Network, AMessageArrivesAsItWasSent) {
  Ros2Network robot(ownNetwork()), heel(ownNetwork());
  heel.subscribe(kScan);
  const auto writer = robot.writer();
  LaserScanMsg scan = filled<LaserScanMsg>();
  scan.ranges.assign(100000, 1.5F);  // many packets
  std::optional<LiveMessage> message;
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, scan);
    message = heel.next(0.2);
    return message.has_value();
  }));
  EXPECT_EQ(message->topic.name, "/scan");
  EXPECT_EQ(message->topic.type, LaserScanMsg::kType);
  EXPECT_EQ(message->bytes, bytesOf(scan));
}

TEST(Ros2Network, TopicsAreKnownByRosNamesAndTypes) {
  Ros2NetworkParams of_robot = ownNetwork();
  of_robot.ros_namespace = "/robot1";
  Ros2Network robot(of_robot), heel(of_robot), elsewhere(ownNetwork());
  const auto writer = robot.writer();
  writer->write("/scan", 0, filled<LaserScanMsg>());
  writer->write("/camera/image_raw", 0, filled<ImageMsg>());
  EXPECT_TRUE(waitFor([&] { return heel.topics().size() == 2 && elsewhere.topics().size() == 2; }));
  EXPECT_EQ(heel.topics()[0].name, "/camera/image_raw");
  EXPECT_EQ(heel.topics()[0].type, "sensor_msgs/Image");
  EXPECT_EQ(heel.topics()[1].name, "/scan");
  EXPECT_EQ(elsewhere.topics()[1].name, "/robot1/scan");
  EXPECT_TRUE(heel.hasWriter("/scan"));
  EXPECT_FALSE(heel.hasWriter("/odom"));
}

TEST(Ros2Network, WhoComesLateGetsWhatIsLatched) {
  Ros2Network robot(ownNetwork());
  const auto writer = robot.writer();
  writer->write("/tf_static", 0, filled<TFMessageMsg>(), true);
  Ros2Network heel(ownNetwork());
  heel.subscribe({"/tf_static", TFMessageMsg::kType, {}}, true);
  std::optional<LiveMessage> message;
  EXPECT_TRUE(waitFor([&] { return (message = heel.next(0.2)).has_value(); }));
  EXPECT_EQ(message->bytes, bytesOf(filled<TFMessageMsg>()));
}

TEST(Ros2Network, OfWhatWaitsTheNewestAreKept) {
  Ros2Network robot(ownNetwork()), heel(ownNetwork());
  heel.subscribe(kScan, false, 2);
  const auto writer = robot.writer();
  LaserScanMsg scan;
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, scan);
    return heel.next(0.1).has_value();
  }));
  while (heel.next(0.5)) continue;
  for (scan.ranges = {1.0F}; scan.ranges[0] < 10.0F; ++scan.ranges[0]) {
    writer->write("/scan", 0, scan);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  std::vector<float> got;
  while (const auto message = heel.next(0.0)) {
    LaserScanMsg read;
    readMessage(BagForm::kRos2, message->bytes.data(), message->bytes.size(), read);
    got.push_back(read.ranges.at(0));
  }
  EXPECT_LE(got.size(), 2U);
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(got.back(), 9.0F);
}

TEST(Ros2Network, ATopicThatIsLeftIsSilent) {
  Ros2Network robot(ownNetwork()), heel(ownNetwork());
  heel.subscribe(kScan);
  const auto writer = robot.writer();
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, LaserScanMsg());
    return heel.next(0.1).has_value();
  }));
  writer->write("/scan", 0, LaserScanMsg());
  heel.unsubscribe("/scan");
  EXPECT_FALSE(heel.next(0.3));
  heel.subscribe(kScan);
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, LaserScanMsg());
    return heel.next(0.1).has_value();
  })) << "and can be heard again";
}

/// Cyclone DDS sends a scan, and gets a velocity.
TEST(Ros2Network, SpeaksWithAnotherMakersDds) {
#ifndef HEEL_CYCLONE_PEER
  GTEST_SKIP() << "Cyclone DDS is not installed (cyclonedds-dev, cyclonedds-tools)";
#else
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"true\"/></Interfaces></General></Domain></CycloneDDS>",
         1);
  const std::string call = HEEL_CYCLONE_PEER " " + std::to_string(ownNetwork().domain);
  const std::unique_ptr<FILE, int (*)(FILE*)> peer(popen(call.c_str(), "r"), pclose);
  Ros2Network heel(ownNetwork());
  heel.subscribe(kScan);
  std::optional<LiveMessage> message;
  ASSERT_TRUE(waitFor([&] { return (message = heel.next(0.2)).has_value(); }));
  LaserScanMsg scan;
  readMessage(BagForm::kRos2, message->bytes.data(), message->bytes.size(), scan);
  EXPECT_EQ(scan.header.stamp.ns, 12500000000);
  EXPECT_EQ(scan.header.frame_id, "laser");
  EXPECT_EQ(scan.angle_min, -1.0F);
  EXPECT_EQ(scan.range_max, 8.0F);
  EXPECT_THAT(scan.ranges, testing::ElementsAre(1.5F, 2.5F, 3.5F));

  const auto writer = heel.writer();
  TwistMsg twist;
  twist.linear.x = 0.25;
  twist.angular.z = -0.5;
  EXPECT_TRUE(waitFor([&] { return heel.hasListener("/cmd_vel"); }));
  std::thread sending([&] {
    for (int i = 0; i < 100; ++i) {
      writer->write("/cmd_vel", 0, twist);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  char said[64] = {};
  EXPECT_NE(fgets(said, sizeof said, peer.get()), nullptr);
  EXPECT_STREQ(said, "0.250 -0.500\n");
  sending.join();
#endif
}

TEST(Ros2Network, TheEnvironmentTellsTheDomain) {
  setenv("ROS_DOMAIN_ID", "17", 1);
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_EQ(ros2Environment().domain, 17);
  EXPECT_TRUE(ros2Environment().localhost_only);
  setenv("ROS_DOMAIN_ID", "seventeen", 1);
  EXPECT_THROW(ros2Environment(), std::invalid_argument);
  unsetenv("ROS_DOMAIN_ID");
  unsetenv("ROS_LOCALHOST_ONLY");
  EXPECT_EQ(ros2Environment().domain, 0);
}

/// Keeps the velocities that are sent.
class Wheels final : public BagWriter {
 public:
  explicit Wheels(std::vector<double>& sent) : sent_(sent) {}
  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool) override {}

 private:
  void add(std::size_t) override {}
  void put(std::size_t, std::int64_t, const std::vector<std::uint8_t>& bytes) override {
    TwistMsg twist;
    readMessage(BagForm::kRos2, bytes.data(), bytes.size(), twist);
    sent_.push_back(twist.linear.x);
  }
  std::vector<double>& sent_;
};

TEST(CommandSender, SendsWhatIsFreshThenZeros) {
  std::vector<double> sent;
  CommandSenderParams params;
  params.rate_hz = 100.0;
  params.timeout_s = 0.2;
  std::size_t stopped = 0;
  {
    CommandSender sender(std::make_unique<Wheels>(sent), params);
    sender.set({0.25, 0.1});
    EXPECT_TRUE(waitFor([&] { return (stopped = sender.stopped()) == 1; }));
  }
  EXPECT_EQ(stopped, 1U) << "nothing came for too long";
  EXPECT_THAT(sent, testing::Contains(0.25));
  EXPECT_EQ(sent.back(), 0.0);
}

TEST(CommandSender, SendsZerosAtTheEndHoweverItEnds) {
  std::vector<double> sent;
  CommandSenderParams params;
  params.timeout_s = 1000.0;
  try {
    CommandSender sender(std::make_unique<Wheels>(sent), params);
    sender.set({0.25, 0.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    throw std::runtime_error("lost the map");
  } catch (const std::runtime_error&) {
  }
  ASSERT_GE(sent.size(), 5U);
  for (auto last = sent.end() - 5; last != sent.end(); ++last) EXPECT_EQ(*last, 0.0);
}

}  // namespace
}  // namespace heel
