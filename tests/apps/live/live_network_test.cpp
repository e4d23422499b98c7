// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/filled_message.hpp"
#include "tests/support/roscore.hpp"
#include <heel/apps/live/command_sender.hpp>
#include <heel/apps/live/live_network.hpp>

#include <gmock/gmock.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <thread>

namespace heel {
namespace {

using test::filled;
using test::Roscore;
using testing::HasSubstr;
using testing::Not;

/// Those that this build has.
std::vector<BagForm> networks() {
  std::vector<BagForm> known;
#ifdef HEEL_HAS_ROS1
  known.push_back(BagForm::kRos1);
#endif
#ifdef HEEL_HAS_ROS2
  known.push_back(BagForm::kRos2);
#endif
  return known;
}

/// A program is one node of ROS 1, and so has one roscore.
Roscore& roscore() {
  static Roscore core;
  return core;
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

/// Empty if nobody sends on it.
std::string typeOn(const LiveNetwork& network, const std::string& topic) {
  for (const BagTopic& known : network.topics()) {
    if (known.name == topic) return known.type;
  }
  return {};
}

template <class Message>
Message decoded(const LiveMessage& message, BagForm form) {
  Message read;
  EXPECT_TRUE(message.topic.holds<Message>()) << message.topic.type << " " << message.topic.md5;
  readMessage(form, message.bytes.data(), message.bytes.size(), read);
  return read;
}

class OnNetwork : public testing::Test {
 protected:
  explicit OnNetwork(BagForm ros) : ros_(ros) {}
  void SetUp() override {
    if (ros_ != BagForm::kRos1) return;
    if (!Roscore::isInstalled()) GTEST_SKIP() << "roscore is not installed (python3-roslaunch)";
    roscore();
  }

  /// Of this machine only, and of this test only.
  std::unique_ptr<LiveNetwork> open(const std::string& ros_namespace = {}) const {
    LiveNetworkParams params;
    params.ros = ros_;
    params.ros_namespace = ros_namespace;
    params.domain = 1 + static_cast<int>(getpid() % 200);
    params.localhost_only = true;
    return openNetwork(params);
  }

  /// Sends velocities until another program, which prints what came, has ended.
  std::string saidOfVelocities(LiveNetwork& network, FILE* program) const {
    const auto writer = network.writer();
    TwistMsg twist;
    twist.linear.x = 0.25;
    twist.angular.z = -0.5;
    std::atomic<bool> is_said{false};
    std::thread sending([&] {
      while (!is_said) {
        writer->write("/cmd_vel", 0, twist);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    });
    std::string said;
    for (int c = fgetc(program); c != EOF; c = fgetc(program)) said += static_cast<char>(c);
    is_said = true;
    sending.join();
    return said;
  }

  BagForm ros_;
};

class EachNetwork : public OnNetwork, public testing::WithParamInterface<BagForm> {
 protected:
  EachNetwork() : OnNetwork(GetParam()) {}
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachNetwork);
INSTANTIATE_TEST_SUITE_P(Live, EachNetwork, testing::ValuesIn(networks()), [](const auto& tested) {
  return tested.param == BagForm::kRos1 ? "Ros1" : "Ros2";
});

TEST_P(EachNetwork, AMessageArrivesAsItWasSent) {
  const auto robot = open(), heel = open();
  heel->subscribe(kScan);
  const auto writer = robot->writer();
  LaserScanMsg scan = filled<LaserScanMsg>();
  scan.ranges.assign(100000, 1.5F);  // many packets
  std::optional<LiveMessage> message;
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, scan);
    message = heel->next(0.2);
    return message.has_value();
  }));
  std::vector<std::uint8_t> bytes;
  writeMessage(ros_, scan, bytes);
  EXPECT_EQ(message->bytes, bytes);
  EXPECT_EQ(message->topic.name, "/scan");
  EXPECT_TRUE(message->topic.holds<LaserScanMsg>());
}

TEST_P(EachNetwork, TopicsAreKnownByRosNamesAndTypes) {
  const auto robot = open("/robot1"), heel = open("robot1/"), elsewhere = open(),
             other = open("/robot");
  const auto writer = robot->writer();
  writer->write("/scan", 0, filled<LaserScanMsg>());
  writer->write("/camera/image_raw", 0, filled<ImageMsg>());
  EXPECT_TRUE(waitFor([&] {
    return typeOn(*heel, "/scan") == "sensor_msgs/LaserScan" &&
           typeOn(*heel, "/camera/image_raw") == "sensor_msgs/Image" &&
           typeOn(*elsewhere, "/robot1/scan") == "sensor_msgs/LaserScan";
  }));
  EXPECT_EQ(typeOn(*heel, "/odom"), "");
  EXPECT_EQ(typeOn(*elsewhere, "/scan"), "");
  for (const BagTopic& topic : other->topics()) EXPECT_THAT(topic.name, Not(HasSubstr("scan")));
}

TEST_P(EachNetwork, WhoComesLateGetsWhatIsLatched) {
  const auto robot = open();
  const auto writer = robot->writer();
  writer->write("/tf_static", 0, filled<TFMessageMsg>(), true);
  const auto heel = open();
  heel->subscribe({"/tf_static", TFMessageMsg::kType, {}}, true);
  std::optional<LiveMessage> message;
  ASSERT_TRUE(waitFor([&] { return (message = heel->next(0.2)).has_value(); }));
  EXPECT_FALSE(decoded<TFMessageMsg>(*message, ros_).transforms.empty());
}

TEST_P(EachNetwork, OfWhatWaitsTheNewestAreKept) {
  const auto robot = open(), heel = open();
  heel->subscribe(kScan, false, 2);
  const auto writer = robot->writer();
  LaserScanMsg scan;
  EXPECT_TRUE(waitFor([&] {
    writer->write("/scan", 0, scan);
    return heel->next(0.1).has_value();
  }));
  while (heel->next(0.5)) continue;
  for (scan.ranges = {1.0F}; scan.ranges[0] < 10.0F; ++scan.ranges[0]) {
    writer->write("/scan", 0, scan);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  std::vector<float> got;
  while (const auto message = heel->next(0.0)) {
    got.push_back(decoded<LaserScanMsg>(*message, ros_).ranges.at(0));
  }
  EXPECT_LE(got.size(), 2U);
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(got.back(), 9.0F);
}

TEST_P(EachNetwork, ATopicThatIsLeftIsSilent) {
  const auto robot = open(), heel = open();
  heel->subscribe(kScan);
  const auto writer = robot->writer();
  const auto isHeard = [&] {
    writer->write("/scan", 0, LaserScanMsg());
    return heel->next(0.1).has_value();
  };
  EXPECT_TRUE(waitFor(isHeard));
  writer->write("/scan", 0, LaserScanMsg());
  heel->unsubscribe("/scan");
  EXPECT_FALSE(heel->next(0.3));
  heel->subscribe(kScan);
  EXPECT_TRUE(waitFor(isHeard)) << "and can be heard again";
}

using Program = std::unique_ptr<FILE, int (*)(FILE*)>;

#ifdef HEEL_HAS_ROS1

class OnRos1 : public OnNetwork {
 protected:
  OnRos1() : OnNetwork(BagForm::kRos1) {}
};

/// rospy sends what a robot does, and gets a velocity.
TEST_F(OnRos1, SpeaksWithRospy) {
  const std::string python = "/usr/bin/python3 ";
  const std::string imports = "-c 'import geometry_msgs, nav_msgs, rospy, sensor_msgs'";
  if (std::system((python + imports + " 2> /dev/null").c_str()) != 0) {
    GTEST_SKIP() << "rospy or its messages are not installed (python3-{rospy,nav-msgs})";
  }
  const std::string peer = HEEL_SOURCE_DIR "/tests/apps/live/ros1_peer.py";
  const Program robot(popen((python + peer).c_str(), "r"), pclose);
  const auto heel = open();
  std::map<std::string, LiveMessage> came;
  std::vector<std::string> subscribed;
  EXPECT_TRUE(waitFor([&] {
    for (const BagTopic& topic : heel->topics()) {
      const bool is_wanted =
          topic.holds<LaserScanMsg>() || topic.holds<OdometryMsg>() || topic.holds<ImageMsg>();
      if (!is_wanted || std::count(subscribed.begin(), subscribed.end(), topic.name) > 0) continue;
      heel->subscribe(topic);
      subscribed.push_back(topic.name);
    }
    if (auto message = heel->next(0.2)) came[message->topic.name] = *message;
    return came.size() == 3;
  }));
  const auto scan = decoded<LaserScanMsg>(came["/scan"], ros_);
  EXPECT_EQ(scan.header.stamp.ns, 12500000000);
  EXPECT_EQ(scan.header.frame_id, "laser");
  EXPECT_EQ(scan.angle_min, -1.0F);
  EXPECT_EQ(scan.range_max, 8.0F);
  EXPECT_THAT(scan.ranges, testing::ElementsAre(1.5F, 2.5F, 3.5F));
  const auto odometry = decoded<OdometryMsg>(came["/odom"], ros_);
  EXPECT_EQ(odometry.child_frame_id, "base_footprint");
  EXPECT_EQ(odometry.pose.pose.position.x, 0.75);
  const auto image = decoded<ImageMsg>(came["/image"], ros_);
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_THAT(image.data, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
  EXPECT_EQ(saidOfVelocities(*heel, robot.get()), "0.250 -0.500\n");
}

TEST_F(OnRos1, RostopicReadsWhatIsSent) {
  if (std::system("command -v rostopic > /dev/null") != 0) {
    GTEST_SKIP() << "rostopic is not installed (python3-rostopic)";
  }
  const auto heel = open("/robot1");
  const Program rostopic(popen("rostopic echo -n1 /robot1/cmd_vel", "r"), pclose);
  EXPECT_THAT(saidOfVelocities(*heel, rostopic.get()),
              testing::AllOf(HasSubstr("x: 0.25\n"), HasSubstr("z: -0.5\n")));
}

TEST_F(OnRos1, AMessageTellsItsOwnType) {
  const auto robot = open(), heel = open();
  heel->subscribe({"/cmd_vel", TwistMsg::kType, {}});
  const auto writer = robot->writer();
  std::optional<LiveMessage> message;
  ASSERT_TRUE(waitFor([&] {
    writer->write("/cmd_vel", 0, filled<OdometryMsg>());
    return (message = heel->next(0.2)).has_value();
  }));
  EXPECT_FALSE(message->topic.holds<TwistMsg>());
  EXPECT_TRUE(message->topic.holds<OdometryMsg>());
}

TEST_F(OnRos1, TfIsThatOfAllRobots) {
  const auto robot = open("/robot1"), elsewhere = open();
  const auto writer = robot->writer();
  writer->write("/tf", 0, filled<TFMessageMsg>());
  EXPECT_TRUE(waitFor([&] { return typeOn(*elsewhere, "/tf") == TFMessageMsg::kType; }));
  EXPECT_TRUE(waitFor([&] { return typeOn(*robot, "/tf") == TFMessageMsg::kType; }));
}

TEST_F(OnRos1, NothingComesWhileRoscoreIsGone) {
  const auto robot = open(), heel = open();
  heel->subscribe(kScan);
  const auto writer = robot->writer();
  const auto isHeard = [&] {
    writer->write("/scan", 0, LaserScanMsg());
    return heel->next(0.1).has_value();
  };
  EXPECT_TRUE(waitFor(isHeard));
  EXPECT_EQ(heel->trouble(), "");
  roscore().stop();
  EXPECT_TRUE(waitFor([&] { return !heel->trouble().empty(); }));
  EXPECT_THAT(heel->trouble(), HasSubstr("roscore does not answer"));
  EXPECT_FALSE(isHeard());
  EXPECT_TRUE(heel->topics().empty());
  roscore().start();
  EXPECT_TRUE(waitFor(isHeard)) << "and is heard again";
  EXPECT_EQ(heel->trouble(), "");
  EXPECT_TRUE(waitFor([&] { return typeOn(*heel, "/scan") == LaserScanMsg::kType; }))
      << "and the new roscore knows it";
}

#endif
#ifdef HEEL_HAS_ROS2

class OnRos2 : public OnNetwork {
 protected:
  OnRos2() : OnNetwork(BagForm::kRos2) {}
};

/// Cyclone DDS sends a scan, and gets a velocity.
TEST_F(OnRos2, SpeaksWithAnotherMakersDds) {
#ifndef HEEL_CYCLONE_PEER
  GTEST_SKIP() << "Cyclone DDS is not installed (cyclonedds-dev, cyclonedds-tools)";
#else
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"true\"/></Interfaces></General></Domain></CycloneDDS>",
         1);
  const std::string call = HEEL_CYCLONE_PEER " " + std::to_string(1 + getpid() % 200);
  const Program peer(popen(call.c_str(), "r"), pclose);
  const auto heel = open();
  heel->subscribe(kScan);
  std::optional<LiveMessage> message;
  ASSERT_TRUE(waitFor([&] { return (message = heel->next(0.2)).has_value(); }));
  const auto scan = decoded<LaserScanMsg>(*message, ros_);
  EXPECT_EQ(scan.header.stamp.ns, 12500000000);
  EXPECT_EQ(scan.header.frame_id, "laser");
  EXPECT_EQ(scan.angle_min, -1.0F);
  EXPECT_EQ(scan.range_max, 8.0F);
  EXPECT_THAT(scan.ranges, testing::ElementsAre(1.5F, 2.5F, 3.5F));
  EXPECT_EQ(saidOfVelocities(*heel, peer.get()), "0.250 -0.500\n");
#endif
}

#endif

TEST(LiveNetwork, TheEnvironmentTellsRosAndDomain) {
  setenv("ROS_VERSION", "1", 1);
  setenv("ROS_DOMAIN_ID", "17", 1);
  setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_EQ(rosEnvironment().ros, BagForm::kRos1);
  EXPECT_EQ(rosEnvironment().domain, 17);
  EXPECT_TRUE(rosEnvironment().localhost_only);
  setenv("ROS_DOMAIN_ID", "seventeen", 1);
  EXPECT_THROW(rosEnvironment(), std::invalid_argument);
  unsetenv("ROS_VERSION");
  unsetenv("ROS_DOMAIN_ID");
  unsetenv("ROS_LOCALHOST_ONLY");
  EXPECT_EQ(rosEnvironment().ros, BagForm::kRos2);
  EXPECT_EQ(rosEnvironment().domain, 0);
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
