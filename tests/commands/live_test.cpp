// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A robot and the follower as two programs, with a network between them.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/support/roscore.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <future>
#include <optional>
#include <regex>

namespace heel::test {
namespace {

using testing::HasSubstr;

constexpr const char* kRosa =
    "{name: rosa, height_m: 1.7, start: [4.4, 1.5], speed_mps: 0.7, outfit: {top: {color: red}, "
    "trousers: {color: charcoal}}, path: [{wait_s: 5}, {to: [2.4, 0.4]}, {to: [3.4, -0.6]}, "
    "{to: [2.6, 0.6]}, {to: [3.4, -0.4]}, {to: [2.8, 0.4]}, {to: [3.6, -0.6]}, {to: [3.0, 0.4]}, "
    "{to: [3.4, -0.6]}, {to: [2.6, 0.6]}, {to: [3.4, -0.4]}, {to: [2.8, 0.4]}, {to: [3.6, -0.6]}, "
    "{to: [4.2, 0.0]}]}";
constexpr const char* kCamera =
    "{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 160, height: 120, view_deg: 60, rate_hz: 5}";

/// Those that this build has.
std::vector<std::string> networks() {
  std::vector<std::string> known;
#ifdef HEEL_HAS_ROS1
  known.emplace_back("ros1");
#endif
#ifdef HEEL_HAS_ROS2
  known.emplace_back("ros2");
#endif
  return known;
}

class Live : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (isRos1()) {
      if (!Roscore::isInstalled()) GTEST_SKIP() << "roscore is not installed (python3-roslaunch)";
      roscore_.emplace();
    }
    setenv("ROS_LOCALHOST_ONLY", "1", 1);
    domain_ = std::to_string(1 + getpid() % 200);
    folder_.write("hall.yaml", hallScene("60", kRosa, kCamera));
  }
  void TearDown() override { unsetenv("ROS_LOCALHOST_ONLY"); }

  static bool isRos1() { return GetParam() == "ros1"; }

  /// Simulated time is as slow as the machine needs.
  std::future<HeelRun> robot(const std::string& duration_s, const std::string& speed = "1") {
    return std::async(std::launch::async, [=] {
      return heel({"simulate", folder_ / "hall.yaml", "--live", GetParam(), "--domain", domain_,
                   "--duration", duration_s, "--speed", speed});
    });
  }
  /// One of the robot's other programs says a word; whether the robot does as told.
  testing::AssertionResult obeys(const std::string& word, const std::string& state,
                                 const std::string& wheels) const {
    const std::string call = std::string(HEEL_LIVE_PEER) + (isRos1() ? " 1 " : " 2 ") + domain_ +
                             " " + word + " " + state + " " + wheels;
    if (std::system(call.c_str()) == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "after '" << word << "' it is not so that it is '" << state << "' and " << wheels;
  }
  std::vector<std::string> live(std::vector<std::string> more, bool map_is_sent = false) const {
    return joined({"live", map_is_sent ? "--map-topic" : "--map",
                   map_is_sent ? "/map" : folder_ / "hall.yaml", "--robot-start", "0.5,0,0",
                   "--domain", domain_, "--out", folder_ / "live", "--ros", isRos1() ? "1" : "2"},
                  more);
  }

  TempFolder folder_;
  std::string domain_;
  std::optional<Roscore> roscore_;
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Live);
INSTANTIATE_TEST_SUITE_P(Networks, Live, testing::ValuesIn(networks()),
                         [](const auto& tested) { return tested.param; });

TEST_P(Live, ARobotOnTheNetworkLearnsAPersonFollowsThemAndDoesAsItIsTold) {
  auto robot = this->robot("55");
  const HeelRun follower =
      heelUntil(live({"--limit", "90", "--wait", "60"}, true), "s: follow", [this](pid_t) {
        EXPECT_TRUE(obeys("go", "any", "moves"));
        EXPECT_TRUE(obeys("pause", "paused", "stands"));
        EXPECT_TRUE(obeys("dance", "any", "stands"));
        EXPECT_TRUE(obeys("go", "any", "moves"));
        sleep(1);
        EXPECT_TRUE(obeys("forget", "learn", "stands"));
        EXPECT_TRUE(obeys("stop", "any", "ends"));
      });
  const HeelRun world = robot.get();
  ASSERT_EQ(follower.exit_code, 130) << follower.err;
  ASSERT_TRUE(succeeds(world));
  EXPECT_THAT(follower.warnings(), testing::Contains(HasSubstr("'dance' is not known; it takes")));
  EXPECT_THAT(follower.err, HasSubstr("/camera/left/image_rect_color"));
  EXPECT_THAT(follower.err, testing::Not(HasSubstr("nobody hears")));
  EXPECT_THAT(follower.err, HasSubstr("s: follow"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "live/report.html"));
  std::smatch drove;
  ASSERT_TRUE(std::regex_search(world.out, drove, std::regex("drove ([0-9.]+) m by ([0-9]+) ")))
      << world.out;
  EXPECT_GT(std::stod(drove[1]), 0.05);
  EXPECT_GT(std::stoi(drove[2]), 100);
  EXPECT_THAT(world.out, HasSubstr("contacts by the robot 0"));
}

TEST_P(Live, WithoutARobotItSaysWhatIsMissing) {
  EXPECT_TRUE(failsWith(heel(live({"--wait", "1"})), {"nothing is sent on the network"}));
}

TEST_P(Live, SaysThatTheRobotIsGone) {
  auto robot = this->robot("4");
  const HeelRun follower = heel(live({"--limit", "12", "--wait", "60"}));
  ASSERT_TRUE(succeeds(robot.get()));
  EXPECT_EQ(follower.exit_code, 0) << follower.err;
  EXPECT_THAT(follower.err, HasSubstr("no picture has come for a second"));
}

TEST_P(Live, WithDryItSendsNothing) {
  auto robot = this->robot("8");
  const HeelRun follower = heel(live({"--limit", "3", "--wait", "60", "--dry"}));
  EXPECT_EQ(follower.exit_code, 0) << follower.err;
  EXPECT_THAT(robot.get().out, HasSubstr("drove 0.00 m by 0 commands"));
}

TEST_P(Live, WarnsOnceIfNobodyHearsItsVelocities) {
  auto robot = this->robot("12");
  const HeelRun follower =
      heel(live({"--limit", "5", "--wait", "60", "--command-topic", "/wheels", "--stamped"}));
  ASSERT_TRUE(succeeds(robot.get()));
  EXPECT_EQ(follower.exit_code, 0) << follower.err;
  EXPECT_THAT(follower.warnings(),
              testing::Contains(HasSubstr("nobody hears /wheels as TwistStamped")).Times(1));
}

TEST_P(Live, RefusesANetworkThatCannotBe) {
  EXPECT_TRUE(
      failsWith(heel({"live", "--map", folder_ / "hall.yaml", "--domain", "300"}), {"--domain"}));
}

TEST_P(Live, RefusesAPlaceWithoutAMap) {
  EXPECT_TRUE(failsWith(heel({"live", "--robot-start", "0,0,0", "--out", folder_ / "live"}),
                        {"--robot-start", "--map"}));
}

#ifdef HEEL_HAS_ROS1

class LiveByRoscore : public Live {};

INSTANTIATE_TEST_SUITE_P(Networks, LiveByRoscore, testing::Values("ros1"),
                         [](const auto& tested) { return tested.param; });

TEST_P(LiveByRoscore, WithoutItItSaysSo) {
  setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);
  const std::vector<std::string> sentence = {"no roscore at http://127.0.0.1:1", "ROS_MASTER_URI"};
  EXPECT_TRUE(failsWith(heel(live({})), sentence));
  EXPECT_TRUE(failsWith(robot("4").get(), sentence));
  setenv("ROS_MASTER_URI", "nowhere", 1);
  EXPECT_TRUE(failsWith(heel(live({})), {"ROS_MASTER_URI must be like http://localhost:11311"}));
}

TEST_P(LiveByRoscore, SaysThatItIsGoneAndGoesOnWhenItIsBack) {
  auto robot = this->robot("20");
  const HeelRun follower = heelUntil(live({"--limit", "12", "--wait", "60"}), "learn", [&](pid_t) {
    roscore_->stop();
    sleep(4);
    roscore_->start();
  });
  ASSERT_TRUE(succeeds(robot.get()));
  EXPECT_EQ(follower.exit_code, 0) << follower.err;
  EXPECT_THAT(follower.err, HasSubstr("roscore does not answer"));
  EXPECT_THAT(follower.err, HasSubstr("a picture has come again"));
}

#endif

}  // namespace
}  // namespace heel::test
