// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel filter, planview and inspect on many clouds at once.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/cloud_files.hpp"
#include "tests/support/data.hpp"
#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <gmock/gmock.h>

#include <sstream>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::SizeIs;

std::string point(double x, double y, double z, const cv::Vec3b& bgr) {
  return pcdPoint(x, y, z, bgr[2], bgr[1], bgr[0]);
}

/// The row of a summary that is about a file.
std::string rowOf(const std::string& csv, const std::string& file) {
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("/" + file + ",") != std::string::npos) return line;
  }
  return "";
}

/// Two clouds with points of the jumper's colour, one without, one without colours, two of no use.
class ManyClouds : public testing::Test {
 protected:
  ManyClouds() {
    writeSmallModel(model_);
    fs::create_directories(in_);
    const auto jumper = point(0, 0, 2, SmallRecording::kJumper);
    const auto wall = point(1, 0, 2, SmallRecording::kWall);
    writeAsciiPcd(in_ / "2.pcd", {jumper, wall, jumper, "nan nan nan 0"}, true, 2);
    writeAsciiPly(in_ / "10.ply", {"0 0 2 190 40 45", "1 0 2 155 160 150"});
    writeAsciiPcd(in_ / "11.pcd", {wall, wall});
    writeAsciiPcd(in_ / "12.pcd", {"1 2 3"}, false);
    writeAsciiPcd(in_ / "13.pcd", {jumper, wall});
    truncateBy(in_ / "13.pcd", 20);
    writeText(in_ / "14.pcd", "no cloud");
  }

  HeelRun filter(const fs::path& out, const std::vector<std::string>& options = {}) {
    return heel({"filter", "--model", model_, in_, "--out", out}, options);
  }

  TempFolder folder_;
  fs::path model_ = folder_ / "person.yaml";
  fs::path in_ = folder_ / "in";
  fs::path out_ = folder_ / "out";
};

TEST_F(ManyClouds, AreFilteredAndTheFateOfEachIsTold) {
  const HeelRun run = filter(out_);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.out, HasSubstr("6 clouds: 3 failed, 2 written, 1 nothing; kept 3 of 8 points"));
  EXPECT_THAT(run.errors(), ElementsAre(AllOf(HasSubstr("12.pcd"), HasSubstr("no colour")),
                                        AllOf(HasSubstr("13.pcd"), HasSubstr("truncated")),
                                        AllOf(HasSubstr("14.pcd"), HasSubstr("not a PCD file")),
                                        HasSubstr("3 of 6 clouds failed")));
  EXPECT_THAT(filesBelow(out_), ElementsAre("10.ply", "2.pcd", "summary.csv", "summary.json"));
  const std::string csv = readText(out_ / "summary.csv");
  EXPECT_THAT(rowOf(csv, "2.pcd"),
              HasSubstr(",written,PCD,ascii,1,2,2,x y z rgb,rgb,4,3,2,2.pcd,"));
  EXPECT_THAT(rowOf(csv, "10.ply"), HasSubstr(",written,PLY,ascii,0,2,1,x y z rgb,rgb,2,2,1,"));
  EXPECT_THAT(rowOf(csv, "11.pcd"), HasSubstr("none of its points passes"));
  EXPECT_THAT(rowOf(csv, "12.pcd"), HasSubstr(",failed,PCD,ascii,0,1,1,x y z,none,1,1,0,,"));
  const auto json = summaryIn(out_);
  EXPECT_EQ(json["files"], 6);
  EXPECT_EQ(json["outcomes"]["failed"], 3);
  EXPECT_EQ(json["reasons"].size(), 4U);
  EXPECT_EQ(readCloud(out_ / "2.pcd").facts.points(), 2U);
  EXPECT_EQ(readCloud(out_ / "10.ply").cloud[0].r, 190);
}

TEST_F(ManyClouds, GiveTheSameBytesWhateverTheThreads) {
  filter(folder_ / "one", {"--threads", "1"});
  filter(folder_ / "four", {"--threads", "4"});
  EXPECT_THAT(filesBelow(folder_ / "one"), SizeIs(4));
  EXPECT_TRUE(contentOf(folder_ / "one") == contentOf(folder_ / "four"));
}

TEST_F(ManyClouds, ThatAllWorkAreASuccess) {
  const HeelRun run = heel(
      {"filter", "--model", model_, in_ / "2.pcd", in_ / "1*.ply", "--out", out_, "--negative"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("2 clouds: 2 written; kept 2 of 6 points"));
}

TEST_F(ManyClouds, KeepOrganizedKeepsTheShape) {
  ASSERT_TRUE(succeeds(
      heel({"filter", "--model", model_, in_ / "2.pcd", "--keep-organized", "--out", out_})));
  const CloudFile cloud = readCloud(out_ / "2.pcd");
  EXPECT_EQ(cloud.facts.height, 2U);
  EXPECT_EQ(cloud.facts.finite_points, 2U);
}

TEST_F(ManyClouds, MayBecomePlyFromPcdAsOneFile) {
  ASSERT_TRUE(succeeds(
      heel({"filter", "--model", model_, in_ / "2.pcd", "--out", folder_ / "person.ply"})));
  EXPECT_EQ(readCloud(folder_ / "person.ply").facts.points(), 2U);
}

TEST_F(ManyClouds, NeedACallThatSaysWhereTo) {
  EXPECT_TRUE(failsWith(heel({"filter", "--model", model_, in_}), {"--out"}));
  EXPECT_TRUE(
      failsWith(heel({"filter", "--model", model_, in_, "--out", folder_ / "a.pcd"}), {"folder"}));
  EXPECT_TRUE(
      failsWith(heel({"filter", "--model", model_, in_, "--out", in_}), {"in", "which is read"}));
  fs::create_directories(folder_ / "more");
  fs::copy(in_ / "2.pcd", folder_ / "more/2.pcd");
  EXPECT_TRUE(failsWith(heel({"filter", "--model", model_, in_, folder_ / "more", "--out", out_}),
                        {"more/2.pcd", "same name"}));
  EXPECT_TRUE(failsWith(heel({"filter", "--model", model_, in_ / "x*.pcd", "--out", out_}),
                        {"x*.pcd", "no PCD or PLY file fits"}));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(ManyClouds, OnAFullDiskLeaveAllAsItWas) {
  ASSERT_TRUE(succeeds(heel({"filter", "--model", model_, in_ / "10.ply", "--out", out_})));
  const std::string before = readText(out_ / "summary.csv");
  std::vector<std::string> points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back(point(0.001 * i, 0.37 * (i % 97), 2, SmallRecording::kJumper));
  }
  writeAsciiPcd(in_ / "2.pcd", points);
  const HeelRun run =
      heel({"filter", "--model", model_, in_ / "2.pcd", in_ / "10.ply", "--out", out_}, 20000);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors(), Contains(AllOf(HasSubstr("2.pcd"), HasSubstr("cannot be written"))));
  EXPECT_THAT(filesBelow(out_), ElementsAre("10.ply", "summary.csv", "summary.json"));
  EXPECT_EQ(readText(out_ / "summary.csv"), before);
}

TEST_F(ManyClouds, AreInspectedByKindAndOneByOne) {
  const HeelRun some = heel({"inspect", in_ / "1[012].p*"});
  EXPECT_TRUE(succeeds(some));
  EXPECT_THAT(
      some.out,
      AllOf(HasSubstr("1 x PLY ascii, not organized, colour in rgb, fields x y z rgb"),
            HasSubstr("12.pcd: PCD ascii, not organized, no colour, fields x y z; 1 points, "
                      "0.0 % of them NaN")));
  const HeelRun all = heel({"inspect", in_});
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_THAT(all.out, HasSubstr("2.pcd: PCD ascii, organized 2x2, colour in rgb"));
  EXPECT_THAT(all.errors(), ElementsAre(HasSubstr("truncated"), HasSubstr("not a PCD file"),
                                        HasSubstr("2 of 6 clouds failed")));
}

TEST_F(ManyClouds, AreInspectedAlone) {
  const HeelRun run = heel({"inspect", in_ / "10.ply"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, AllOf(HasSubstr("PLY ascii"), HasSubstr("x from 0.00 to 1.00 m"),
                             HasSubstr("no floor is seen")));
  const HeelRun organized = heel({"inspect", in_ / "2.pcd", "--out", folder_ / "2.png"});
  EXPECT_TRUE(succeeds(organized));
  EXPECT_TRUE(fs::exists(folder_ / "2.png"));
}

/// A cloud of the world: a person-sized pillar of the jumper's colour, and a low one of the wall's.
void writePillars(const fs::path& file) {
  std::vector<std::string> points;
  for (double z = 0.0; z <= 1.7; z += 0.01) {
    for (double y = 0.8; y <= 1.2; y += 0.02) {
      for (const double x : {2.9, 2.95, 3.0, 3.05, 3.1}) {
        points.push_back(point(x, y, z, SmallRecording::kJumper));
        if (z < 0.8) points.push_back(point(x, y - 2.0, z, SmallRecording::kWall));
      }
    }
  }
  writeAsciiPcd(file, points);
}

TEST_F(ManyClouds, ArePlannedFromAbove) {
  writePillars(folder_ / "pillars.pcd");
  const std::vector<std::string> call = {
      "planview", folder_ / "pillars.pcd", "--up", "z", "--height", "0", "--out", out_};
  const HeelRun all = heel(call);
  ASSERT_TRUE(succeeds(all));
  EXPECT_THAT(all.out, HasSubstr("2 blobs, 1 of a person's shape"));
  EXPECT_THAT(filesBelow(out_),
              ElementsAre("blobs.csv", "pillars.pcd.png", "summary.csv", "summary.json"));
  auto with_model = call;
  with_model.insert(with_model.end(), {"--model", model_});
  const HeelRun person = heel(with_model);
  ASSERT_TRUE(succeeds(person));
  EXPECT_THAT(person.out, HasSubstr("1 blobs, 1 of a person's shape"));
  EXPECT_THAT(readText(out_ / "blobs.csv"), HasSubstr("pillars.pcd,1,3.0"));
}

TEST_F(ManyClouds, ArePlannedByTheCameraYamlBesideThem) {
  fs::create_directories(folder_ / "room");
  writePillars(folder_ / "room/pillars.pcd");
  writeText(folder_ / "room/camera.yaml",
            "T_ground_camera: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n");
  ASSERT_TRUE(succeeds(heel({"planview", folder_ / "room", "--out", out_})));
  EXPECT_THAT(rowOf(readText(out_ / "summary.csv"), "pillars.pcd"), HasSubstr(",camera.yaml,"));
}

TEST_F(ManyClouds, WithoutAFloorSayHowToGiveOne) {
  const HeelRun run = heel({"planview", in_ / "2.pcd", "--out", out_});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.errors(), Contains(AllOf(HasSubstr("2.pcd"), HasSubstr("--height"))));
  EXPECT_TRUE(failsWith(heel({"planview", in_, "--up", "w", "--out", out_}), {"'w' is no axis"}));
}

TEST_F(ManyClouds, OfTheRealSetAreAllToldApart) {
  HEEL_NEED_DATA("clouds");
  const fs::path set = dataFolder() / "clouds";
  const HeelRun inspected = heel({"inspect", set});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out,
              AllOf(HasSubstr("8 clouds:"),
                    HasSubstr("3 x PCD binary_compressed, organized, colour "
                              "in rgba"),
                    HasSubstr("2 x PCD binary_compressed, organized, colour in rgb,"),
                    HasSubstr("1 x PCD binary_compressed, organized, no colour"),
                    HasSubstr("2 x PCD binary_compressed, not organized, no colour")));

  const HeelRun filtered = heel({"filter", "--model", model_, set, "--out", out_ / "filter"});
  EXPECT_EQ(filtered.signal, 0);
  EXPECT_THAT(filtered.errors(), IsSupersetOf({HasSubstr("person.pcd: the cloud has no colour"),
                                               HasSubstr("room_scan1.pcd: the cloud has no colour"),
                                               HasSubstr("3 of 8 clouds failed")}));

  const HeelRun planned = heel({"planview", set, "--out", out_ / "plan"});
  EXPECT_EQ(planned.signal, 0);
  const std::string csv = readText(out_ / "plan/summary.csv");
  EXPECT_THAT(rowOf(csv, "five_people.pcd"), HasSubstr(",drawn,"));
  EXPECT_THAT(rowOf(csv, "five_people.pcd"), testing::EndsWith(",5,"));
  EXPECT_THAT(rowOf(csv, "table_scene_mug_stereo_textured.pcd"), HasSubstr("no floor"));
  const HeelRun scans =
      heel({"planview", set / "room_scan*.pcd", "--up", "z", "--out", out_ / "z"});
  EXPECT_TRUE(succeeds(scans));
}

}  // namespace
}  // namespace heel::test
