// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Bags, from one verb to the next.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/results/result_files.hpp>

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;

const std::string kBagScene =
    hallScene("2", R"({name: rosa, height_m: 1.8, start: [3, -0.5],
     outfit: {top: {color: red}, trousers: {color: charcoal}}, path: [{to: [3, 0.8]}]})",
              "{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 320, height: 240, view_deg: 60}");

std::map<std::string, std::size_t> countsOf(const std::filesystem::path& path) {
  const auto bag = openBag(path);
  std::map<std::string, std::size_t> counts;
  BagMessage raw;
  while (bag->next(raw)) ++counts[bag->topics()[raw.topic].name];
  EXPECT_EQ(bag->lost(), "");
  return counts;
}

class Bags : public testing::Test {
 protected:
  Bags() {
    writeText(folder_ / "hall.yaml", kBagScene);
    writeSmallModel(folder_ / "person.yaml");
  }

  void simulate(const std::string& name, const std::string& bag) {
    ASSERT_TRUE(succeeds(heel(
        {"simulate", folder_ / "hall.yaml", "--out", folder_ / name, "--bag", folder_ / bag})));
  }

  HeelRun track(const std::string& recording, const std::string& out,
                const std::vector<std::string>& more = {"--no-film"}) {
    return heel(
        {"track", folder_ / recording, "--model", folder_ / "person.yaml", "--out", folder_ / out},
        more);
  }

  TempFolder folder_;
};

TEST_F(Bags, OfASimulationGiveTheTracksOfItsFolderByteForByte) {
  simulate("hall", "hall.bag");
  simulate("again", "hall_ros2");
  simulate("once_more", "hall.mcap");
  ASSERT_TRUE(endsWell(track("hall", "out")));
  const std::string tracks = readText(folder_ / "out/tracks.csv");
  EXPECT_GT(std::count(tracks.begin(), tracks.end(), '\n'), 10) << "somebody was tracked";
  for (const std::string bag :
       {"hall.bag", "hall_ros2", "hall_ros2/hall_ros2_0.db3", "hall.mcap"}) {
    const HeelRun run = track(bag, "bag_out");
    ASSERT_TRUE(endsWell(run));
    EXPECT_THAT(run.warnings(), ElementsAre());
    for (const char* table : {"tracks.csv", "frames.csv"}) {
      EXPECT_TRUE(readText(folder_ / "bag_out" / table) == readText(folder_ / "out" / table))
          << bag << " " << table;
    }
  }
}

TEST_F(Bags, AreReadFromAndToWhatIsAskedFor) {
  for (const std::string bag : {"hall.bag", "hall.db3", "hall.mcap"}) {
    simulate("for_" + bag, bag);
    const HeelRun run = track(bag, "out", {"--no-film", "--from", "0.75", "--to", "1.25"});
    ASSERT_TRUE(endsWell(run));
    const auto frames = readFrames(folder_ / "out/frames.csv");
    ASSERT_GT(frames.size(), 2U) << bag;
    EXPECT_GE(frames.front().stamp_s, 0.75);
    EXPECT_LE(frames.back().stamp_s, 1.4);  // the bag may begin a frame after 0
  }
  EXPECT_TRUE(failsWith(track("hall.bag", "out", {"--from", "1000"}), {"hall.bag", "that part"}));
}

TEST_F(Bags, AreInspected) {
  simulate("hall", "hall.bag");
  const HeelRun run = heel({"inspect", folder_ / "hall.bag", "--out", folder_ / "hall.png"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("hall.bag: ROS 1 bag, "));
  EXPECT_THAT(run.out, testing::ContainsRegex("/scan +sensor_msgs/LaserScan"));
  EXPECT_THAT(run.out, HasSubstr("320x240"));
  EXPECT_THAT(run.out,
              HasSubstr("frame camera_optical in base_footprint at (0.050, 0.060, 1.130)"));
  EXPECT_THAT(run.out, HasSubstr("camera 1.13 m over the floor"));
}

TEST_F(Bags, ThatWereCutOffAreTrackedAsFarAsTheyGo) {
  simulate("hall", "hall.bag");
  const auto bag = folder_ / "hall.bag";
  truncateBy(bag, std::filesystem::file_size(bag) / 3);
  const HeelRun run = track("hall.bag", "out");
  ASSERT_TRUE(endsWell(run));
  EXPECT_THAT(run.warnings(), testing::Contains(HasSubstr("the bag is cut off at byte")));
  writeText(folder_ / "hall.bag", "");
  EXPECT_TRUE(failsWith(track("hall.bag", "out2"), {"hall.bag", "empty (0 bytes)"}));
}

TEST_F(Bags, OfResultsHoldWhatViewersShow) {
  simulate("hall", "hall.bag");
  for (const std::string bag : {"results.bag", "results.db3", "results.mcap"}) {
    const HeelRun run = track("hall.bag", "out", {"--bag", folder_ / bag});
    ASSERT_TRUE(endsWell(run));
    EXPECT_THAT(run.out, HasSubstr(bag));
    const auto counts = countsOf(folder_ / bag);
    for (const char* topic : {"/heel/tracks", "/heel/markers", "/heel/image/compressed", "/tf"}) {
      EXPECT_EQ(counts.count(topic) > 0 ? counts.at(topic) : 0, 20U) << topic;
    }
  }
}

TEST_F(Bags, OfFollowingHoldTheMapAndTheRobot) {
  ASSERT_TRUE(succeeds(heel({"follow", folder_ / "hall.yaml", "--out", folder_ / "out", "--limit",
                             "0.5", "--no-film", "--bag", folder_ / "follow.bag"})));
  const auto counts = countsOf(folder_ / "follow.bag");
  EXPECT_EQ(counts.at("/map"), 1U);
  EXPECT_GE(counts.at("/tf"), 5U);
  EXPECT_GE(counts.at("/heel/image/compressed"), 4U);
}

TEST_F(Bags, DoNotCostMemoryByTheirLength) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps freed memory";
#endif
  for (const char* name : {"long.bag", "long.db3", "long.mcap"}) {
    const auto peakOf_kB = [&](int frames) {
      RecordingInfo info;
      info.camera.left = {320, 240, 260.0, 260.0, 159.5, 119.5};
      Frame frame;
      frame.image_bgr = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 115, 125));
      frame.depth_m = cv::Mat(240, 320, CV_32FC1, cv::Scalar(2.0));
      info.T_base_camera = Eigen::Isometry3d::Identity();
      SensorBag bag(folder_ / name, info);
      for (int i = 1; i <= frames; ++i) {
        frame.stamp_s = 0.1 * i;
        bag.add(frame);
      }
      bag.commit();
      const HeelRun run = track(name, "out");
      EXPECT_TRUE(endsWell(run));
      return run.peak_kB;
    };
    const long short_kB = peakOf_kB(40);
    // 360 frames more are 110 MB of depth alone.
    EXPECT_LT(peakOf_kB(400), short_kB + 12'000) << name << ", " << short_kB << " kB for 40 frames";
  }
}

TEST_F(Bags, WithoutATopicThatIsNamedAreAnError) {
  simulate("hall", "hall.bag");
  EXPECT_TRUE(failsWith(track("hall.bag", "out", {"--left-topic", "/a", "--right-topic", "/b"}),
                        {"hall.bag", "'/a'", "its topics are"}));
}

TEST_F(Bags, OfRealRobotsAreListed) {
  const std::string name = "laser_bags/demo_stationary_simple_environment.bag";
  HEEL_NEED_DATA(name);
  const HeelRun run = heel({"inspect", dataFolder() / name});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("1265 messages on 1 topic"));
  EXPECT_THAT(run.out, HasSubstr("126.0 s at 10.0 Hz, frame laser"));
  EXPECT_TRUE(failsWith(heel({"track", dataFolder() / name, "--model", folder_ / "person.yaml",
                              "--out", folder_ / "out"}),
                        {"/scan (sensor_msgs/LaserScan)"}));
}

}  // namespace
}  // namespace heel::test
