// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel follow: what it writes, and what it can't be asked.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A room in which somebody stands beside the robot.
constexpr const char* kFollowScene = R"(
name: room
walls:
  - {from: [0, 0], to: [5, 0]}
  - {from: [5, 0], to: [5, 4]}
  - {from: [5, 4], to: [0, 4]}
  - {from: [0, 4], to: [0, 0]}
lights:
  - {lamp: [2, 2, 2.4], power: 30, radius_m: 0.2}
people:
  - name: bruno
    start: [0.7, 3.2]
    outfit: {top: {color: forest}, trousers: {color: charcoal}}
    path: [{wait_s: 100}]
robot:
  start: [0.7, 2]
  camera: {at: [0, 0, 1], width: 160, height: 120, view_deg: 60}
)";

class Follow : public testing::Test {
 protected:
  Follow() { writeText(folder_ / "room.yaml", kFollowScene); }
  HeelRun follow(const std::string& scene, const std::vector<std::string>& more = {}) {
    return heel({"follow", scene, "--out", folder_ / "out"}, more);
  }
  TempFolder folder_;
};

TEST_F(Follow, WritesAReportOfAsLongAsItMay) {
  const HeelRun run = follow(folder_ / "room.yaml", {"--limit", "1.5", "--no-film"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_TRUE(run.errors().empty());
  EXPECT_THAT(run.out, HasSubstr("timeout"));
  EXPECT_THAT(run.out, HasSubstr("report.html"));
  EXPECT_THAT(filesBelow(folder_ / "out"),
              ElementsAre("follow.csv", "report.html", "summary.json", "timing.csv"));
  const auto summary = summaryIn(folder_ / "out");
  EXPECT_EQ(summary.at("outcome"), "timeout");
  for (const char* key : {"distance_m", "elapsed_s", "seek_s", "moving_speed_mps", "contacts",
                          "wrong_person_s", "near_others_s", "min_clearance_m"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
}

TEST_F(Follow, TakesAnotherImageSizeAndRate) {
  const HeelRun run = follow(folder_ / "room.yaml", {"--limit", "0.5", "--no-film", "--image-size",
                                                     "160x120", "--rate", "20"});
  ASSERT_TRUE(succeeds(run));
  const std::string rows = readText(folder_ / "out/follow.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 11);
}

TEST_F(Follow, NamesASceneThatIsNone) {
  EXPECT_TRUE(failsWith(follow("attic"), {"attic", "no such scene"}));
  EXPECT_TRUE(failsWith(follow(folder_ / "none.yaml"), {"none.yaml", "no such scene"}));
  writeText(folder_ / "odd.yaml", std::string(kFollowScene) + "wals: []\n");
  EXPECT_TRUE(failsWith(follow(folder_ / "odd.yaml"), {"odd.yaml", "wals"}));
  writeText(folder_ / "binary.yaml", std::string("\0\1\2{", 4));
  EXPECT_TRUE(failsWith(follow(folder_ / "binary.yaml"), {"binary.yaml"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Follow, TakesASceneForOneWhateverFolderHasItsName) {
  std::filesystem::create_directories(folder_ / "home");
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / "");
  const HeelRun run = heel({"follow", "home", "--plan", "nowhere", "--out", "out"});
  std::filesystem::current_path(here);
  EXPECT_TRUE(failsWith(run, {"nowhere: there is no such plan"}));
}

TEST_F(Follow, NeedsSomebodyToFollow) {
  std::string nobody = kFollowScene;
  nobody.replace(nobody.find("people:"), nobody.find("robot:") - nobody.find("people:"), "");
  writeText(folder_ / "empty.yaml", nobody);
  EXPECT_TRUE(failsWith(follow(folder_ / "empty.yaml", {"--no-film"}), {"nobody to follow"}));
}

TEST_F(Follow, NamesAPlanThatIsNone) {
  const std::string room = folder_ / "room.yaml";
  EXPECT_TRUE(failsWith(follow(room, {"--plan", "dance"}), {"dance", "no such plan"}));
  writeText(folder_ / "cut.pnml", "<?xml version=\"1.0\"?>\n<pnml><net id=\"a\"");
  EXPECT_TRUE(failsWith(follow(room, {"--plan", folder_ / "cut.pnml"}), {"cut.pnml"}));
  writeText(folder_ / "empty.pnml", "");
  EXPECT_TRUE(failsWith(follow(room, {"--plan", folder_ / "empty.pnml"}), {"empty.pnml"}));
  writeText(folder_ / "odd.pnml", R"(<pnml><net id="n"><place id="a"><name><value>dance.exec</value>
    </name><initialMarking><value>1</value></initialMarking></place></net></pnml>)");
  EXPECT_TRUE(failsWith(follow(room, {"--plan", folder_ / "odd.pnml"}), {"odd.pnml", "dance"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Follow, SaysThatItCantWrite) {
  writeText(folder_ / "out", "a file, not a folder");
  EXPECT_TRUE(failsWith(follow(folder_ / "room.yaml"), {(folder_ / "out").string()}));
}

TEST_F(Follow, RefusesNumbersThatAreNone) {
  const std::string room = folder_ / "room.yaml";
  EXPECT_TRUE(failsWith(follow(room, {"--seed", "first"}), {"--seed", "first"}));
  EXPECT_TRUE(failsWith(follow(room, {"--limit", "soon"}), {"--limit", "soon"}));
  EXPECT_TRUE(failsWith(follow(room, {"--limit", "-1"}), {"--limit"}));
  EXPECT_TRUE(failsWith(follow(room, {"--limit", "nan"}), {"--limit"}));
  EXPECT_TRUE(failsWith(follow(room, {"--image-size", "640"}), {"--image-size"}));
  EXPECT_TRUE(failsWith(follow(room, {"--image-size", "640x8"}), {"--image-size"}));
  EXPECT_TRUE(failsWith(follow(room, {"--rate", "0"}), {"--rate"}));
}

}  // namespace
}  // namespace heel::test
