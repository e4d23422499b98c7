// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings of a robot that roams past people, tracked on its map.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/stamps.hpp>
#include <heel/apps/results/result_files.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace heel::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Rosa comes from behind the robot and walks about; otto does, later.
const std::string kHall = hallScene("9", R"(name: rosa
    height_m: 1.7
    start: [0.4, -1.6]
    speed_mps: 0.7
    outfit: {top: {color: red}, trousers: {color: charcoal}}
    path:
      - {wait_s: 1}
      - {to: [2.6, -0.9]}
      - {to: [3.2, 0.8]}
      - {to: [2.6, 1.0]}
      - {to: [4.2, -0.8]}
      - {to: [3.6, 1.2]}
  - name: otto
    height_m: 1.8
    start: [0.4, 1.6]
    speed_mps: 0.5
    outfit: {top: {color: navy}, trousers: {color: khaki}}
    path: [{wait_s: 7}, {to: [2.0, 1.4]}, {to: [4.4, 1.4]}])",
                                    "{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 320, "
                                    "height: 240, view_deg: 60}");

class RobotsOnAMap : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = new TempFolder;
    writeText(made() / "hall.yaml", kHall);
    for (const auto& call : std::vector<std::vector<std::string>>{
             {"simulate", made() / "hall.yaml", "--out", made() / "still"},
             {"learn", made() / "still", "--background", "1", "--person", "3", "--out",
              made() / "rosa.yaml"},
             {"simulate", made() / "hall.yaml", "--drive", "roam", "--out", made() / "roam",
              "--bag", made() / "roam.bag"},
             {"map", made() / "hall.yaml", "--out", made() / "map"}}) {
      ASSERT_TRUE(succeeds(heel(call)));
    }
  }
  static void TearDownTestSuite() {
    delete made_;
    made_ = nullptr;
  }
  static const std::filesystem::path& made() { return made_->path(); }

  HeelRun track(const std::filesystem::path& recording, const std::string& out,
                const std::filesystem::path& map = made() / "map/walls.bt",
                const std::vector<std::string>& more = {}) {
    return heel({"track", recording, "--model", made() / "rosa.yaml", "--out", folder_ / out,
                 "--map", map, "--no-film"},
                more);
  }

  enum class Has { kAll, kNoOdometry, kNoScans, kNoPlaceOfTheLaser };

  /// The drive as another bag.
  std::filesystem::path bagOf(const std::string& name, Has has = Has::kAll) {
    const auto recording = openRecording(made() / "roam");
    SensorBag bag(folder_ / name, recording->info());
    if (has != Has::kNoScans && has != Has::kNoPlaceOfTheLaser) {
      bag.setScanner(Eigen::Isometry3d(Eigen::Translation3d(0.12, 0.0, 0.3)), 20.0F);
    }
    const auto odometry = readRows(made() / "roam/odometry.csv", 4, "");
    if (has != Has::kNoOdometry) bag.addTruth(odometry[0][0], {{0.5, 0.0}, 0.0}, {});
    std::size_t next = 0;
    LaserReading reading;
    const auto log = openLaserLog(made() / "roam");
    bool has_scan = log->next(reading);
    Frame frame;
    while (recording->next(frame)) {
      const double s = frame.stamp_s + 1e-6;
      for (; next < odometry.size() && odometry[next][0] <= s; ++next) {
        const auto& row = odometry[next];
        if (has != Has::kNoOdometry) bag.addOdometry(row[0], {{row[1], row[2]}, row[3]});
      }
      for (; has_scan && reading.stamp_s <= s; has_scan = log->next(reading)) {
        if (has != Has::kNoScans) bag.add(reading.stamp_s, reading.scan);
      }
      bag.add(frame);
    }
    bag.commit();
    return folder_ / name;
  }

  struct Nearness {
    int followed = 0, near = 0;
  };

  /// Of the frames in which the target is followed: those in which it is within 0.25 m of where
  /// rosa is in the map.
  Nearness nearnessOf(const std::string& out) {
    std::map<double, Eigen::Vector2d> truth;
    CsvReader people(made() / "roam/people.csv", {"stamp_s", "person", "x_m", "y_m"});
    while (people.next()) {
      if (people.text(1) != "rosa") continue;
      truth[std::round(100.0 * people.number(0))] = {people.number(2), people.number(3)};
    }
    Nearness nearness;
    for (const TrackRow& track : readTracks(folder_ / out / "tracks.csv")) {
      if (!track.is_target || track.status != "confirmed") continue;
      ++nearness.followed;
      const Eigen::Vector2d& rosa = truth.at(std::round(100.0 * track.stamp_s));
      if ((rosa - track.position_m).norm() < 0.25) ++nearness.near;
    }
    return nearness;
  }

  nlohmann::json summary(const std::string& out) { return summaryIn(folder_ / out); }

  TempFolder folder_;

 private:
  static inline TempFolder* made_ = nullptr;
};

TEST_F(RobotsOnAMap, TellWhereThePersonIsInTheMap) {
  const HeelRun run = track(made() / "roam.bag", "out");
  ASSERT_TRUE(succeeds(run));
  const auto [followed, near] = nearnessOf("out");
  EXPECT_GT(followed, 20);
  EXPECT_GE(near, 0.95 * followed);
  EXPECT_EQ(summary("out")["frame"], "map");
}

TEST_F(RobotsOnAMap, TellTheSameByAnyFormatOfBag) {
  for (const char* bag : {"roam.bag", "roam.db3", "roam.mcap"}) track(bagOf(bag), bag + 4);
  const std::string tracks = readText(folder_ / ".bag/tracks.csv");
  EXPECT_GT(nearnessOf(".bag").followed, 20);
  EXPECT_TRUE(tracks == readText(folder_ / ".db3/tracks.csv"));
  EXPECT_TRUE(tracks == readText(folder_ / ".mcap/tracks.csv"));
}

TEST_F(RobotsOnAMap, MayBePutOnAFloorPlanAtAGivenStart) {
  ASSERT_TRUE(succeeds(track(made() / "roam", "out", made() / "map/map.yaml",
                             {"--robot-start", "0.5,0,0", "--scanner", "0.12,0,0"})));
  const auto [followed, near] = nearnessOf("out");
  EXPECT_GT(followed, 20);
  EXPECT_GE(near, 0.95 * followed);
}

TEST_F(RobotsOnAMap, ArePlacedByTfWithoutALaser) {
  ASSERT_TRUE(succeeds(track(bagOf("blind.bag", Has::kNoScans), "out")));
  EXPECT_EQ(summary("out")["frame"], "map");
  const auto [followed, near] = nearnessOf("out");
  EXPECT_GT(followed, 20);
  EXPECT_GE(near, 0.9 * followed) << "by odometry, which drifts";
}

TEST_F(RobotsOnAMap, SayWhatIsWrongWithoutOdometry) {
  const auto silent = bagOf("silent.bag", Has::kNoOdometry);
  EXPECT_TRUE(failsWith(track(silent, "out"),
                        {"silent.bag", "laser scans, but no odometry", "found on a map by"}));
  const HeelRun off_map = heel({"track", silent, "--model", made() / "rosa.yaml", "--out",
                                folder_ / "off_map", "--no-film"});
  EXPECT_THAT(off_map.warnings(), Contains(HasSubstr("no odometry or tf tells how")));
}

TEST_F(RobotsOnAMap, WarnIfNobodyTellsWhereTheLaserIs) {
  const auto bag = bagOf("unplaced.bag", Has::kNoPlaceOfTheLaser);
  const auto untold = Contains(HasSubstr("tf does not join 'laser' to base_footprint"));
  EXPECT_THAT(track(bag, "unplaced").warnings(), untold);
  const auto map = made() / "map/walls.bt";
  EXPECT_THAT(track(bag, "placed", map, {"--scanner", "0.12,0,0"}).warnings(),
              testing::Not(untold));
}

TEST_F(RobotsOnAMap, SayIfTheyAreNotFoundOnIt) {
  writeText(folder_ / "hut.yaml", R"(name: hut
walls:
  - {from: [20, 0], to: [26, 0]}
  - {from: [26, 0], to: [23, 5]}
  - {from: [23, 5], to: [20, 0]}
robot: {start: [23, 1]}
)");
  const HeelRun run = track(made() / "roam.bag", "out", folder_ / "hut.yaml");
  EXPECT_THAT(run.warnings(), Contains(HasSubstr("the robot is not found on the map in them")));
  EXPECT_GT(summary("out")["frames_skipped"].size(), 70U) << "of 90";
}

TEST_F(RobotsOnAMap, AreFollowedInTheShadow) {
  const HeelRun run = heel({"follow", made() / "roam.bag", "--map", made() / "map/walls.bt",
                            "--model", made() / "rosa.yaml", "--out", folder_ / "out"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("would have driven otherwise by"));
  const nlohmann::json summary = this->summary("out");
  EXPECT_EQ(summary["outcome"], "end of log");
  EXPECT_GT(summary["distance_m"], 0.5) << "the robot's own way";
  EXPECT_LT(summary.at("position_rms_m").get<double>(), 0.15);
  EXPECT_GT(summary["with_target_s"], 2.0);
  EXPECT_GT(summary["command_off_mps"], 0.0);
  EXPECT_THAT(readText(folder_ / "out/report.html"),
              HasSubstr("Speed that Heel would have driven"));
}

TEST_F(RobotsOnAMap, AreFollowedInTheShadowWithoutAMapToo) {
  const HeelRun run = heel(
      {"follow", made() / "roam.bag", "--model", made() / "rosa.yaml", "--out", folder_ / "out"});
  ASSERT_TRUE(succeeds(run));
  const nlohmann::json summary = this->summary("out");
  EXPECT_EQ(summary["outcome"], "end of log");
  EXPECT_GT(summary["with_target_s"], 2.0);
}

TEST_F(RobotsOnAMap, AModelIsOfALog) {
  EXPECT_TRUE(
      failsWith(heel({"follow", "home", "--model", made() / "rosa.yaml", "--out", folder_ / "out"}),
                {"--model"}));
}

TEST_F(RobotsOnAMap, AreShownOnIt) {
  const auto pictures = [this](const std::string& out, const std::vector<std::string>& more) {
    EXPECT_TRUE(succeeds(
        heel({"view", made() / "roam.bag", "--out", folder_ / out, "--pictures", "2"}, more)));
    return contentOf(folder_ / out);
  };
  const auto on_map = pictures("on_map", {"--map", made() / "hall.yaml"});
  const auto without = pictures("without", {});
  ASSERT_EQ(on_map.size(), 2U);
  for (const auto& [name, bytes] : on_map) {
    EXPECT_NE(without.count(name), 0U);
    EXPECT_FALSE(bytes == without.at(name)) << name;
  }
}

}  // namespace
}  // namespace heel::test
