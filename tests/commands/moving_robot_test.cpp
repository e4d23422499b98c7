// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings of a robot that drives, from `simulate --drive` to tracks.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/stamps.hpp>
#include <heel/apps/results/result_files.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace heel::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// Where rosa stands in the frame of the robot's start, which is at (0.5, 0) of the hall.
const Eigen::Vector2d kRosa(3.7, 0.6);

std::map<int, std::vector<TrackRow>> tracksOf(const std::filesystem::path& folder) {
  std::map<int, std::vector<TrackRow>> tracks;
  for (const TrackRow& row : readTracks(folder / "tracks.csv")) tracks[row.track_id].push_back(row);
  return tracks;
}

/// The longest track.
std::vector<TrackRow> longestOf(const std::filesystem::path& folder) {
  std::vector<TrackRow> longest;
  for (const auto& [id, rows] : tracksOf(folder)) {
    if (rows.size() > longest.size()) longest = rows;
  }
  return longest;
}

class MovingRobots : public testing::Test {
 protected:
  /// Simulates a drive past rosa, who stands; once for all tests.
  static void SetUpTestSuite() {
    made_ = new TempFolder;
    writeText(made() / "hall.yaml",
              hallScene("7", R"({name: rosa, height_m: 1.8, start: [4.2, 0.6], yaw_deg: 180,
     outfit: {top: {color: red}, trousers: {color: charcoal}}, path: [{wait_s: 60}]})",
                        "{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 320, height: 240, "
                        "view_deg: 60}") +
                  "  odometry: {distance_noise: 0, turn_noise: 0, drift_noise: 0}\n");
    writeText(made() / "way.csv", "x_m,y_m\n1.2,0\n2.4,-0.2\n");
    writeSmallModel(made() / "person.yaml");
    for (const auto& [out, bag] :
         std::map<std::string, std::string>{{"drive", "drive.bag"}, {"again", "drive_ros2"}}) {
      ASSERT_TRUE(succeeds(heel({"simulate", made() / "hall.yaml", "--drive", made() / "way.csv",
                                 "--out", made() / out, "--bag", made() / bag})));
    }
  }
  static void TearDownTestSuite() {
    delete made_;
    made_ = nullptr;
  }
  static const std::filesystem::path& made() { return made_->path(); }

  HeelRun track(const std::filesystem::path& recording, const std::string& out,
                const std::vector<std::string>& more = {"--no-film"}) {
    return heel({"track", recording, "--model", made() / "person.yaml", "--out", folder_ / out},
                more);
  }

  /// The drive with other odometry: what `poses` makes of its poses, or none.
  std::filesystem::path bagWith(const std::string& name,
                                const std::function<void(SensorBag&, double, FloorPose)>& write,
                                bool odometry_first = true) {
    const auto recording = openRecording(made() / "drive");
    SensorBag bag(folder_ / name, recording->info());
    const auto rows = readRows(made() / "drive/odometry.csv", 4, "");
    const auto writeAll = [&] {
      for (const auto& row : rows) write(bag, row[0], {{row[1], row[2]}, row[3]});
    };
    if (odometry_first) writeAll();
    Frame frame;
    while (recording->next(frame)) bag.add(frame);
    if (!odometry_first) writeAll();
    bag.commit();
    return folder_ / name;
  }

  nlohmann::json summary(const std::string& out) { return summaryIn(folder_ / out); }

  TempFolder folder_;

 private:
  static inline TempFolder* made_ = nullptr;
};

TEST_F(MovingRobots, AreDrivenAndTellWhereTheyWere) {
  const auto truth = readRows(made() / "drive/robot.csv", 4, "");
  const auto odometry = readRows(made() / "drive/odometry.csv", 4, "");
  ASSERT_EQ(truth.size(), odometry.size());
  EXPECT_GT(truth.back()[1], 2.2) << "it got there";
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(truth[i][1] - 0.5, odometry[i][1], 0.01) << "odometry without noise";
    EXPECT_NEAR(truth[i][2], odometry[i][2], 0.01);
  }
  EXPECT_THAT(readText(made() / "drive/truth.csv"), HasSubstr(",rosa,3.7000,0.6000,1\n"));
}

// Half a body is nearer to the camera than the body's middle (0.15 m); three deviations of depth
// (0.5 px / (277 px x 0.12 m) times 3 m squared) are 0.4 m for one look at 3 m, a tenth of that for
// what a track makes of ten looks a second, and less from nearer. Where the picture cuts her as the
// robot passes, the middle of what is seen is a quarter of her width aside (0.11 m).
constexpr double kNear_m = 0.30;

TEST_F(MovingRobots, KeepATrackOfWhoStandsWhereTheyStand) {
  const HeelRun run = track(made() / "drive", "out");
  ASSERT_TRUE(run.signal == 0 && (run.exit_code == 0 || run.exit_code == 4)) << run.err;
  EXPECT_THAT(run.warnings(), ElementsAre());
  const auto rows = longestOf(folder_ / "out");
  EXPECT_GT(rows.size(), 40U) << "of 70 frames; she leaves the picture as the robot passes";
  for (const TrackRow& row : rows) {
    EXPECT_LT((row.position_m - kRosa).norm(), kNear_m)
        << row.stamp_s << ": " << row.position_m.transpose();
  }
  EXPECT_EQ(summary("out")["frame"], "odom");
}

TEST_F(MovingRobots, GiveTheSameTracksAsFolderAndAsBags) {
  ASSERT_TRUE(endsWell(track(made() / "drive", "out")));
  EXPECT_FALSE(readTracks(folder_ / "out/tracks.csv").empty());
  for (const char* bag : {"drive.bag", "drive_ros2"}) {
    ASSERT_TRUE(endsWell(track(made() / bag, bag)));
    for (const char* table : {"tracks.csv", "frames.csv"}) {
      EXPECT_TRUE(readText(folder_ / bag / table) == readText(folder_ / "out" / table))
          << bag << " " << table;
    }
  }
}

TEST_F(MovingRobots, GiveOtherTracksThanIfTheyStood) {
  track(made() / "drive.bag", "out");
  const auto standing = bagWith("standing.bag", [](SensorBag& bag, double s, const FloorPose&) {
    bag.addOdometry(s, {{4.0, 1.0}, 0.5});
  });
  const auto silent = bagWith("silent.bag", [](SensorBag&, double, const FloorPose&) {});
  ASSERT_TRUE(endsWell(track(standing, "standing")));
  ASSERT_TRUE(endsWell(track(silent, "silent")));
  EXPECT_TRUE(readText(folder_ / "standing/tracks.csv") == readText(folder_ / "silent/tracks.csv"))
      << "odometry that says that the robot stands changes nothing";
  EXPECT_FALSE(readText(folder_ / "out/tracks.csv") == readText(folder_ / "silent/tracks.csv"));
  EXPECT_EQ(summary("standing")["frame"], "base");
  double greatest_m = 0.0;
  for (const auto& [id, rows] : tracksOf(folder_ / "silent")) {
    for (const TrackRow& row : rows)
      greatest_m = std::max(greatest_m, (row.position_m - kRosa).norm());
  }
  EXPECT_GT(greatest_m, 1.0) << "without odometry who stands seems to come";
}

TEST_F(MovingRobots, AreWarnedOfWithoutOdometry) {
  const auto silent = bagWith("silent.bag", [](SensorBag&, double, const FloorPose&) {});
  EXPECT_THAT(track(silent, "out").warnings(),
              Contains(HasSubstr("no odometry or tf tells how: places are as seen from it")));
  EXPECT_THAT(summary("out")["warnings"].dump(), HasSubstr("the camera seems to move from"));
}

TEST_F(MovingRobots, AreNotLearnedFrom) {
  EXPECT_TRUE(failsWith(
      heel({"learn", made() / "drive.bag", "--out", folder_ / "rosa.yaml", "--background", "3"}),
      {"drive.bag", "the odometry says that the robot moves from 0.",
       "learning needs it to stand"}));
  const auto silent = bagWith("silent.bag", [](SensorBag&, double, const FloorPose&) {});
  const HeelRun run = heel({"learn", silent, "--out", folder_ / "rosa.yaml", "--background", "3"});
  EXPECT_THAT(run.err, HasSubstr("it seems that the robot moves from"));
}

TEST_F(MovingRobots, MayHaveOdometryThatIsRarerThanPicturesAndComesAfterThem) {
  track(made() / "drive.bag", "out");
  int n = 0;
  const auto rare = bagWith(
      "rare.bag",
      [&n](SensorBag& bag, double s, const FloorPose& pose) {
        if (n++ % 4 == 0) bag.addOdometry(s, pose);
      },
      false);
  const HeelRun run = track(rare, "rare");
  EXPECT_THAT(run.warnings(), ElementsAre());
  const auto often = longestOf(folder_ / "out"), rarely = longestOf(folder_ / "rare");
  ASSERT_GT(rarely.size(), 40U);
  for (const TrackRow& row : rarely) EXPECT_LT((row.position_m - kRosa).norm(), kNear_m);
  for (std::size_t i = 0; i < std::min(often.size(), rarely.size()); ++i) {
    EXPECT_LT((often[i].position_m - rarely[i].position_m).norm(), 0.02) << often[i].stamp_s;
  }
}

TEST_F(MovingRobots, MayTellTheWayOfTheirCameraInsteadInAnyFrame) {
  track(made() / "drive", "out");
  const auto copied = folder_ / "tum";
  std::filesystem::copy(made() / "drive", copied, std::filesystem::copy_options::recursive);
  const Eigen::Isometry3d T_base_camera = *openRecording(copied)->info().T_base_camera;
  const Eigen::Isometry3d T_any_odom =
      Eigen::Translation3d(7, -3, 2) *
      Eigen::Isometry3d(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
  std::ostringstream lines;
  lines.precision(12);
  for (const auto& row : readRows(copied / "odometry.csv", 4, "")) {
    const Eigen::Isometry3d T = T_any_odom * basePose({{row[1], row[2]}, row[3]}) * T_base_camera;
    const Eigen::Quaterniond q(T.linear());
    lines << row[0] << ' ' << T.translation().transpose() << ' ' << q.x() << ' ' << q.y() << ' '
          << q.z() << ' ' << q.w() << '\n';
  }
  std::filesystem::remove(copied / "odometry.csv");
  writeText(copied / "groundtruth.txt", lines.str());
  EXPECT_THAT(track(copied, "tum_out").warnings(), ElementsAre());
  const auto by_wheels = longestOf(folder_ / "out"), by_camera = longestOf(folder_ / "tum_out");
  ASSERT_EQ(by_wheels.size(), by_camera.size());
  for (std::size_t i = 0; i < by_wheels.size(); ++i) {
    EXPECT_LT((by_wheels[i].position_m - by_camera[i].position_m).norm(), 0.001);
  }
}

TEST_F(MovingRobots, SkipAndCountThePicturesInAGapOfTf) {
  const auto gap = bagWith("gap.bag", [](SensorBag& bag, double s, const FloorPose& pose) {
    if (s < 2.05 || s > 3.25) bag.addOdometry(s, pose);
  });
  const HeelRun run = track(gap, "out");
  EXPECT_THAT(run.warnings(), Contains(AllOf(HasSubstr("12 frames were left out"),
                                             HasSubstr("the odometry has a gap there"))));
  const auto frames = summary("out")["frames_skipped"];
  ASSERT_THAT(frames, SizeIs(12));
  EXPECT_EQ(frames[0]["frame"], 22);
  EXPECT_EQ(summary("out")["frames"], 58);
}

TEST_F(MovingRobots, NameTheFrameInTheirBags) {
  ASSERT_EQ(
      track(made() / "drive.bag", "out", {"--no-film", "--bag", folder_ / "results.bag"}).signal,
      0);
  const auto bag = openBag(folder_ / "results.bag");
  BagMessage raw;
  std::size_t poses = 0;
  double farthest_m = 0.0;
  while (bag->next(raw)) {
    const BagTopic& topic = bag->topics()[raw.topic];
    if (topic.holds<TFMessageMsg>()) {
      TFMessageMsg message;
      bag->read(raw, message);
      EXPECT_EQ(message.transforms[0].header.frame_id, "odom");
      farthest_m = std::max(farthest_m, message.transforms[0].transform.translation.x);
      ++poses;
    } else if (topic.name == "/heel/tracks") {
      PoseArrayMsg message;
      bag->read(raw, message);
      EXPECT_EQ(message.header.frame_id, "odom");
    }
  }
  EXPECT_EQ(poses, 70U);
  EXPECT_GT(farthest_m, 1.5);
}

TEST_F(MovingRobots, RoamThroughASceneByThemselves) {
  ASSERT_TRUE(succeeds(heel({"simulate", made() / "hall.yaml", "--drive", "roam", "--out",
                             folder_ / "roam", "--duration", "3"})));
  const auto odometry = readRows(folder_ / "roam/odometry.csv", 4, "");
  double way_m = 0.0;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    way_m += std::hypot(odometry[i][1] - odometry[i - 1][1], odometry[i][2] - odometry[i - 1][2]) +
             std::abs(odometry[i][3] - odometry[i - 1][3]);
  }
  EXPECT_GT(way_m, 0.3);
  EXPECT_TRUE(failsWith(heel({"simulate", made() / "hall.yaml", "--drive", folder_ / "none.csv",
                              "--out", folder_ / "none"}),
                        {"none.csv"}));
}

}  // namespace
}  // namespace heel::test
