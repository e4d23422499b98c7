// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/live/on_network.hpp"
#include "tests/support/data.hpp"
#include "tests/support/filled_message.hpp"
#include <heel/apps/live/command_sender.hpp>

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace heel {
namespace {

using test::decoded;
using test::EachNetwork;
using test::filled;
using test::OnNetwork;
using test::Program;
using test::roscore;
using test::waitFor;
using testing::HasSubstr;
using testing::Not;

const BagTopic kScan{"/scan", LaserScanMsg::kType, {}};

/// Empty if nobody sends on it.
std::string typeOn(const LiveNetwork& network, const std::string& topic) {
  for (const BagTopic& known : network.topics()) {
    if (known.name == topic) return known.type;
  }
  return {};
}

/// Sends velocities until another program, which prints what came, has ended.
std::string saidOfVelocities(LiveNetwork& network, FILE* program) {
  const auto writer = network.writer();
  TwistMsg twist;
  twist.linear.x = 0.25;
  twist.angular.z = -0.5;
  return test::saidMeanwhile(program, [&] { writer->write("/cmd_vel", 0, twist); });
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachNetwork);
INSTANTIATE_TEST_SUITE_P(Live, EachNetwork, testing::ValuesIn(test::networks()), test::networkName);

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
  const auto namesake = open("/robot");
  const auto its_writer = namesake->writer();
  its_writer->write("/odom", 0, filled<OdometryMsg>());
  EXPECT_TRUE(waitFor([&] {
    return typeOn(*heel, "/scan") == "sensor_msgs/LaserScan" &&
           typeOn(*heel, "/camera/image_raw") == "sensor_msgs/Image" &&
           typeOn(*elsewhere, "/robot1/scan") == "sensor_msgs/LaserScan" &&
           typeOn(*other, "/odom") == "nav_msgs/Odometry";
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
  heel->subscribe({"/tf_static", TFMessageMsg::kType, {}}, Delivery::kLatched);
  std::optional<LiveMessage> message;
  ASSERT_TRUE(waitFor([&] { return (message = heel->next(0.2)).has_value(); }));
  EXPECT_FALSE(decoded<TFMessageMsg>(*message, ros_).transforms.empty());
}

TEST_P(EachNetwork, OfWhatWaitsTheNewestAreKept) {
  const auto robot = open(), heel = open();
  heel->subscribe(kScan, Delivery::kAsSent, 2);
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
  heel->unsubscribe("/scan");
  EXPECT_FALSE(isHeard() || isHeard() || isHeard());
  heel->subscribe(kScan);
  EXPECT_TRUE(waitFor(isHeard)) << "and can be heard again";
}

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

TEST_F(OnRos2, NpmsRos2HearsUs) {
  if (!test::hasNpm("@foxglove/ros2")) GTEST_SKIP() << test::kNoNpm << "@foxglove/ros2";
  const std::string call = "NODE_PATH='" + test::nodeModules() +
                           "' node '" HEEL_SOURCE_DIR "/tests/apps/live/ros2_peer.cjs' " +
                           std::to_string(1 + getpid() % 200);
  TFMessageMsg fixed;
  auto& transform = fixed.transforms.emplace_back();
  transform.header.frame_id = "base_link";
  transform.child_frame_id = "camera";
  transform.transform.translation = {0.25, -0.5, 1.5};
  const auto robot = open();
  const auto writer = robot->writer();
  const Program peer(popen(call.c_str(), "r"), pclose);
  const auto send = [&] { writer->write("/tf_static", 0, fixed, true); };
  EXPECT_EQ(test::saidMeanwhile(peer.get(), send), "base_link camera 0.25 -0.5 1.5 1\n");
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

/// What was sent to the wheels; to be looked at while it is sent.
class Sent {
 public:
  void add(double forward_mps) {
    const std::lock_guard<std::mutex> lock(mutex_);
    all_.push_back(forward_mps);
  }
  std::vector<double> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return all_;
  }
  /// How many zeros end it.
  std::size_t zeros() const {
    const std::vector<double> sent = all();
    const auto drives = std::find_if(sent.rbegin(), sent.rend(), [](double v) { return v != 0.0; });
    return static_cast<std::size_t>(drives - sent.rbegin());
  }

 private:
  mutable std::mutex mutex_;
  std::vector<double> all_;
};

/// Keeps the velocities that are sent.
class Wheels final : public BagWriter {
 public:
  explicit Wheels(Sent& sent) : sent_(sent) {}
  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool) override {}

 private:
  void add(std::size_t) override {}
  void put(std::size_t, std::int64_t, const std::vector<std::uint8_t>& bytes) override {
    TwistMsg twist;
    readMessage(BagForm::kRos2, bytes.data(), bytes.size(), twist);
    sent_.add(twist.linear.x);
  }
  Sent& sent_;
};

TEST(CommandSender, SendsWhatIsFreshThenZeros) {
  Sent sent;
  CommandSenderParams params;
  params.rate_hz = 100.0;
  params.timeout_s = 0.2;
  CommandSender sender(std::make_unique<Wheels>(sent), params);
  sender.set({0.25, 0.1}, 0.0);
  EXPECT_TRUE(waitFor([&] { return sender.stopped() == 1 && sent.zeros() > 3; }))
      << "nothing came for too long";
  EXPECT_THAT(sent.all(), testing::Contains(0.25));
}

TEST(CommandSender, SendsANewCommandAtOnce) {
  Sent sent;
  CommandSenderParams params;
  params.rate_hz = 0.001;
  params.timeout_s = 1000.0;
  CommandSender sender(std::make_unique<Wheels>(sent), params);
  for (const double forward_mps : {0.25, 0.5}) {
    sender.set({forward_mps, 0.1}, 0.0);
    EXPECT_TRUE(waitFor([&] { return sent.all().back() == forward_mps; }));
  }
}

TEST(CommandSender, SendsZerosWhileTheRobotMustStand) {
  Sent sent;
  std::atomic<bool> must_stand{false};
  CommandSenderParams params;
  params.rate_hz = 100.0;
  params.timeout_s = 1000.0;
  params.must_stand = [&] { return must_stand.load(); };
  CommandSender sender(std::make_unique<Wheels>(sent), params);
  sender.set({0.25, 0.1}, 0.0);
  EXPECT_TRUE(waitFor([&] { return sent.all().back() == 0.25; }));
  must_stand = true;
  EXPECT_TRUE(waitFor([&] { return sent.zeros() > 0; }));
  sender.set({0.5, 0.1}, 0.0);
  EXPECT_TRUE(waitFor([&] { return sent.zeros() > 10; }));
  EXPECT_THAT(sent.all(), Not(testing::Contains(0.5)));
  must_stand = false;
  EXPECT_TRUE(waitFor([&] { return sent.all().back() == 0.5; })) << "the newest";
  EXPECT_EQ(sender.stopped(), 0U) << "the commands were in time";
}

TEST_P(EachNetwork, VelocitiesHaveTheStampsOfTheSensors) {
  const auto robot = open(), heel = open();
  CommandSenderParams params;
  params.stamped = true;
  robot->subscribe({"/cmd_vel", TwistStampedMsg::kType, {}});
  CommandSender sender(heel->writer(), params);
  TwistStampedMsg came;
  const auto next = [&] {
    const auto message = robot->next(0.1);
    if (message) came = decoded<TwistStampedMsg>(*message, ros_);
    return message.has_value();
  };
  ASSERT_TRUE(waitFor(next));
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_NEAR(1e-9 * static_cast<double>(came.header.stamp.ns),
              std::chrono::duration<double>(since_1970).count(), 10.0);
  const double set_s = steadyClock_s();
  sender.set({0.25, -0.5}, 12.5);
  ASSERT_TRUE(waitFor([&] { return next() && came.twist.linear.x != 0.0; }));
  EXPECT_EQ(came.header.frame_id, "base_link");
  EXPECT_EQ(came.twist.linear.x, 0.25);
  EXPECT_EQ(came.twist.angular.z, -0.5);
  const double stamp_s = 1e-9 * static_cast<double>(came.header.stamp.ns);
  EXPECT_GE(stamp_s, 12.5);
  EXPECT_LE(stamp_s, 12.5 + (steadyClock_s() - set_s));
}

TEST(CommandSender, SendsZerosAtTheEndHoweverItEnds) {
  Sent sent;
  CommandSenderParams params;
  params.timeout_s = 1000.0;
  try {
    CommandSender sender(std::make_unique<Wheels>(sent), params);
    sender.set({0.25, 0.0}, 0.0);
    EXPECT_TRUE(waitFor([&] { return sent.all().back() == 0.25; }));
    throw std::runtime_error("lost the map");
  } catch (const std::runtime_error&) {
  }
  EXPECT_GE(sent.zeros(), 5U);
}

}  // namespace
}  // namespace heel
