// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/live/on_network.hpp"
#include <heel/apps/heel/live/live_reports.hpp>
#include <heel/planning/plan_file.hpp>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include <cstdio>
#include <map>

namespace heel {
namespace {

using testing::HasSubstr;

/// Somebody at (2, 1), who walks along y.
Track somebody() {
  Track track;
  track.id = 7;
  track.status = TrackStatus::kConfirmed;
  track.motion.mean << 2.0, 1.0, 0.0, 0.5;
  return track;
}

/// Who has seen nothing yet.
Follower beginner() {
  RobotDescription robot;
  robot.camera.camera.left = {64, 48, 60.0, 60.0, 32.0, 24.0};
  return {robot, nullptr,
          loadPlan(HEEL_SOURCE_DIR "/apps/plans/search.pnml", followingVocabulary()), FloorPose{}};
}

class LiveReportsTest : public test::EachNetwork {
 protected:
  void SetUp() override {
    test::EachNetwork::SetUp();
    if (IsSkipped()) return;
    heel_ = open();
    robot_ = open();
  }

  template <class Message>
  void listen(const std::string& topic) {
    robot_->subscribe({topic, Message::kType, {}}, Delivery::kReliable);
  }

  /// The next message of the topic, which is sent again and again until it comes.
  template <class Message, class Send>
  Message heard(const std::string& topic, const Send& send) {
    std::optional<LiveMessage> message;
    EXPECT_TRUE(test::waitFor([&] {
      send();
      while ((message = robot_->next(0.05)) && message->topic.name != topic) continue;
      return message.has_value();
    }));
    return message ? test::decoded<Message>(*message, ros_) : Message();
  }

  std::unique_ptr<LiveNetwork> heel_, robot_;
};

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(LiveReportsTest);
INSTANTIATE_TEST_SUITE_P(Live, LiveReportsTest, testing::ValuesIn(test::networks()),
                         test::networkName);

TEST_P(LiveReportsTest, OthersHearWhereThePersonAndTheWayAre) {
  ResultBag results(heel_->writer(), "odom");
  listen<PoseStampedMsg>("/heel/target");
  listen<MarkerArrayMsg>("/heel/markers");
  listen<PathMsg>("/heel/path");
  TargetEstimate target;
  target.status = TargetStatus::kFollowed;
  target.track_id = 7;
  target.motion = somebody().motion;
  const auto send = [&] {
    results.addTracks(12.5, {somebody()}, target);
    results.addPath(12.5, {{0.0, 0.0}, {1.0, 0.5}});
  };
  const auto place = heard<PoseStampedMsg>("/heel/target", send);
  EXPECT_EQ(place.header.frame_id, "odom");
  EXPECT_EQ(place.header.stamp.ns, 12500000000);
  EXPECT_EQ(place.pose.position.x, 2.0);
  EXPECT_EQ(place.pose.position.y, 1.0);
  EXPECT_NEAR(place.pose.orientation.z, std::sqrt(0.5), 1e-9) << "facing where they go";
  const auto markers = heard<MarkerArrayMsg>("/heel/markers", send).markers;
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_EQ(markers[0].action, MarkerMsg::kDeleteAll);
  EXPECT_EQ(markers[1].type, MarkerMsg::kCylinder);
  EXPECT_EQ(markers[2].text, "target 7");
  const auto path = heard<PathMsg>("/heel/path", send);
  ASSERT_EQ(path.poses.size(), 2U);
  EXPECT_EQ(path.poses[1].pose.position.x, 1.0);
}

TEST_P(LiveReportsTest, PicturesAreSentWhileSomebodyLooks) {
  ResultBag results(heel_->writer(), "map");
  EXPECT_FALSE(results.isImageWatched());
  listen<CompressedImageMsg>("/heel/image/compressed");
  const cv::Mat picture(4, 6, CV_8UC3, cv::Scalar(10, 200, 30));
  const auto image = heard<CompressedImageMsg>("/heel/image/compressed", [&] {
    if (results.isImageWatched()) results.addImage(3.5, picture);
  });
  EXPECT_EQ(image.header.stamp.ns, 3500000000);
  EXPECT_EQ(cv::imdecode(image.data, cv::IMREAD_COLOR).size(), picture.size());
  robot_->unsubscribe("/heel/image/compressed");
  EXPECT_TRUE(test::waitFor([&] { return !results.isImageWatched(); }));
}

TEST_P(LiveReportsTest, DiagnosticsTellStateAndWhy) {
  Follower follower = beginner();
  LiveReports reports(*heel_, "odom");
  listen<DiagnosticArrayMsg>("/diagnostics");
  const std::vector<double> latencies_s = {0.05, 0.2, 0.1};
  RobotReadings readings;
  double clock_s = 0.0;
  const auto told = [&] {
    return heard<DiagnosticArrayMsg>(
               "/diagnostics",
               [&] {
                 clock_s += 2.0;
                 readings.stamp_s += 0.001;
                 reports.add(follower.step(readings), follower, {latencies_s, 3, 1}, clock_s);
               })
        .status.at(0);
  };
  const DiagnosticStatusMsg learns = told();
  EXPECT_EQ(learns.name, "heel: follower");
  EXPECT_EQ(learns.level, DiagnosticStatusMsg::kOk);
  EXPECT_EQ(learns.message, "learn: learns whom to follow");
  std::map<std::string, std::string> values;
  for (const KeyValueMsg& value : learns.values) values[value.key] = value.value;
  EXPECT_EQ(values["state"], "learn");
  EXPECT_EQ(values["target track"], "none");
  EXPECT_EQ(values["from picture to velocity, 95 of 100 [ms]"], "100");
  EXPECT_EQ(values["pictures left out"], "3");
  EXPECT_EQ(values["commands not in time"], "1");
  const auto toldAt = [&](DiagnosticStatusMsg::Level level) {
    for (int i = 0; i < 100; ++i) {
      DiagnosticStatusMsg status = told();
      if (status.level == level) return status.message;
    }
    return std::string("never");
  };
  follower.pause(true);
  EXPECT_EQ(toldAt(DiagnosticStatusMsg::kWarn), "paused: told to wait");
  follower.pause(false);
  readings.stamp_s += 0.9;
  EXPECT_EQ(toldAt(DiagnosticStatusMsg::kError), "learn: no laser scan");
}

TEST_P(LiveReportsTest, DiagnosticsComeOnceASecondAndWithEachState) {
  Follower follower = beginner();
  LiveReports reports(*heel_, "odom");
  listen<DiagnosticArrayMsg>("/diagnostics");
  double clock_s = 0.0;
  const auto add = [&](double after_s) {
    clock_s += after_s;
    reports.add(follower.step({}), follower, {{}, 0, 0}, clock_s);
  };
  heard<DiagnosticArrayMsg>("/diagnostics", [&] { add(2.0); });
  while (robot_->next(0.3)) continue;
  for (int i = 0; i < 10; ++i) add(0.05);
  EXPECT_FALSE(robot_->next(0.3)) << "nothing is new";
  follower.pause(true);
  add(0.05);
  EXPECT_TRUE(robot_->next(5.0));
  add(1.0);
  EXPECT_TRUE(robot_->next(5.0));
  EXPECT_FALSE(robot_->next(0.3));
}

#ifdef HEEL_HAS_ROS1

class LiveReportsOnRos1 : public test::OnNetwork {
 protected:
  LiveReportsOnRos1() : OnNetwork(BagForm::kRos1) {}
};

TEST_F(LiveReportsOnRos1, RostopicReadsDiagnostics) {
  const char* const needed =
      "command -v rostopic > /dev/null && /usr/bin/python3 -c 'import diagnostic_msgs' 2> "
      "/dev/null";
  if (std::system(needed) != 0) {
    GTEST_SKIP() << "python3-{rostopic,diagnostic-msgs} are not installed";
  }
  const auto heel = open("/robot1");
  Follower follower = beginner();
  LiveReports reports(*heel, "odom");
  const test::Program rostopic(popen("rostopic echo -n1 /robot1/diagnostics", "r"), pclose);
  const std::string said = test::saidMeanwhile(rostopic.get(), [&, clock_s = 0.0]() mutable {
    reports.add(follower.step({}), follower, {{}, 0, 0}, clock_s += 2.0);
  });
  EXPECT_THAT(said, testing::AllOf(HasSubstr("level: 0"), HasSubstr("name: \"heel: follower\""),
                                   HasSubstr("learns whom to follow")));
}

#endif

}  // namespace
}  // namespace heel
