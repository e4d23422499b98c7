// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/output/full_disk.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/results/result_files.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using heel::Output;
using heel::OutputKind;
using heel::ResultFiles;
using heel::test::isThere;
using heel::test::messageOf;
using heel::test::readText;
using heel::test::TempFolder;
using heel::test::writeText;
using testing::HasSubstr;

/// One frame with a target and another track, and one frame without.
void addTwoFrames(ResultFiles& files) {
  files.add(heel::TrackRow{0.2, 1, true, {1.25, -0.5}, {0.3, 0.0}, 12.5, "confirmed"});
  files.add(heel::TrackRow{0.2, 2, false, {4.0, 1.0 / 3.0}, {-0.3, -1e-9}, 3.0, "coasting", 0.25});
  files.add(heel::FrameRow{
      1, 0.2, 900, 850, 800, 3, 2, 2, 1, 0.87, "following", "", {{1.5, -0.25}, 0.1}});
  files.add(heel::FrameRow{2, 0.4, 9, 8, 0, 0, 0, 1, 0, 0.0, "lost",
                           "8 points passed the colour, none the height"});
  files.addTiming(1, {1.5, 0.25});
  files.addTiming(2, {1.0, 0.5});
}

TEST(ResultFiles, HaveTheDocumentedColumns) {
  const TempFolder folder;
  Output output({"track", OutputKind::kFolder, folder / "a/b", {}});
  ResultFiles files(output, {"stereo", "filter"});
  addTwoFrames(files);
  files.close();
  output.commit();
  EXPECT_EQ(readText(folder / "a/b/tracks.csv"),
            "stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status,person_probability\n"
            "0.200000,1,1,1.2500,-0.5000,0.3000,0.0000,12.5000,confirmed,1.0000\n"
            "0.200000,2,0,4.0000,0.3333,-0.3000,0.0000,3.0000,coasting,0.2500\n");
  EXPECT_EQ(readText(folder / "a/b/frames.csv"),
            "frame,stamp_s,color_pixels,color_points,standing_points,blobs,"
            "observations,tracks,target_id,confidence,state,reason,"
            "robot_x_m,robot_y_m,robot_yaw_rad\n"
            "1,0.200000,900,850,800,3,2,2,1,0.8700,following,,1.5000,-0.2500,0.100000\n"
            "2,0.400000,9,8,0,0,0,1,0,0.0000,lost,"
            "\"8 points passed the colour, none the height\",0.0000,0.0000,0.000000\n");
  EXPECT_EQ(readText(folder / "a/b/timing.csv"),
            "frame,stereo_ms,filter_ms\n1,1.500,0.250\n2,1.000,0.500\n");
}

TEST(ResultFiles, AreTheSameBytesOnEveryRun) {
  const TempFolder folder;
  for (const char* run : {"1", "2"}) {
    Output output({"track", OutputKind::kFolder, folder / run, {}});
    ResultFiles files(output, {"all", "half"});
    addTwoFrames(files);
    files.close();
    heel::writeJson(output / "summary.json",
                    {{"z_first", 0.1}, {"a_second", {{"k", 1}, {"b", nullptr}}}});
    output.commit();
  }
  for (const char* name : {"tracks.csv", "frames.csv", "summary.json"}) {
    EXPECT_EQ(readText(folder.path() / "1" / name), readText(folder.path() / "2" / name));
  }
}

TEST(Json, KeepsTheOrderOfItsKeys) {
  const TempFolder folder;
  nlohmann::ordered_json value;
  value["recording"] = "six_people";
  value["frames"] = 108;
  value["accuracy"] = 0.85;
  heel::writeJson(folder / "summary.json", value);
  EXPECT_EQ(readText(folder / "summary.json"),
            "{\n  \"recording\": \"six_people\",\n  \"frames\": 108,\n  \"accuracy\": 0.85\n}\n");
}

TEST(Json, HoldsNamesThatAreNotUtf8) {
  const TempFolder folder;
  heel::writeJson(folder / "summary.json", {{"recording", "caf\xe9"}});
  EXPECT_EQ(readText(folder / "summary.json"), "{\n  \"recording\": \"caf\xef\xbf\xbd\"\n}\n");
}

TEST(Tracks, AreReadAsTheyWereWritten) {
  const TempFolder folder;
  Output output({"track", OutputKind::kFolder, folder.path(), {}});
  ResultFiles files(output, {"a", "b"});
  addTwoFrames(files);
  files.close();
  output.commit();
  const auto rows = heel::readTracks(folder / "tracks.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].stamp_s, 0.2);
  EXPECT_EQ(rows[0].track_id, 1);
  EXPECT_TRUE(rows[0].is_target);
  EXPECT_EQ(rows[0].position_m, Eigen::Vector2d(1.25, -0.5));
  EXPECT_EQ(rows[0].velocity_mps, Eigen::Vector2d(0.3, 0.0));
  EXPECT_EQ(rows[0].score, 12.5);
  EXPECT_EQ(rows[1].status, "coasting");
  EXPECT_EQ(rows[1].person_probability, 0.25);
}

TEST(Tracks, OfOthersNeedNotTellWhetherTheyArePeople) {
  const TempFolder folder;
  writeText(
      folder / "tracks.csv",
      "stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status\n0,1,1,0,0,0,0,1,seen\n");
  EXPECT_EQ(heel::readTracks(folder / "tracks.csv").at(0).person_probability, 1.0);
}

TEST(Tracks, WrongRowIsNamedByFileAndLine) {
  const TempFolder folder;
  const std::string header = "stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status\n";
  writeText(folder / "tracks.csv", header + "0,1,1,0,0,0,0,1,seen\n0,1,1,left,0,0,0,1,seen\n");
  EXPECT_EQ(messageOf([&] { heel::readTracks(folder / "tracks.csv"); }),
            (folder / "tracks.csv").string() + ", line 3: x_m is 'left', not a number");
}

TEST(Truth, IsReadAndItsErrorsNamed) {
  const TempFolder folder;
  const std::string header = "stamp_s,frame,person,x_m,y_m,exact\n";
  writeText(folder / "truth.csv", header + "5.200,27,navy,1.111,0.639,1\n5.4,28,navy,1,2,0\n");
  const auto rows = heel::readTruth(folder / "truth.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].frame, 27U);
  EXPECT_EQ(rows[0].person, "navy");
  EXPECT_EQ(rows[0].position_m, Eigen::Vector2d(1.111, 0.639));
  EXPECT_TRUE(rows[0].exact);
  EXPECT_FALSE(rows[1].exact);
  const auto message = [&](const std::string& text) {
    writeText(folder / "truth.csv", text);
    return messageOf([&] { heel::readTruth(folder / "truth.csv"); });
  };
  const std::string name = (folder / "truth.csv").string();
  EXPECT_EQ(message("stamp_s,x_m,y_m\n"), name + ", line 1: the header has no column 'frame'");
  EXPECT_EQ(message(header + "5.2,27,navy,1,2,perhaps\n"),
            name + ", line 2: exact is 'perhaps', not 0 or 1");
  EXPECT_EQ(message(header + "5.2,-27,navy,1,2,1\n"),
            name + ", line 2: frame is '-27', not a number from 1");
}

TEST(Truth, OfTheRealRecordingsIsRead) {
  HEEL_NEED_DATA("six_people");
  const auto rows = heel::readTruth(heel::test::dataFolder() / "six_people/truth.csv");
  EXPECT_EQ(rows.size(), 226U);
  for (const auto& row : rows) {
    EXPECT_NEAR(row.stamp_s, 0.2 * static_cast<double>(row.frame - 1), 1e-9);
    EXPECT_GE(row.frame, 27U);
    EXPECT_LE(row.frame, 102U);
  }
}

}  // namespace
