// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel plan.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two rooms of 3 m x 3 m with a doorway between them, at y = 1.5.
constexpr const char* kPlanScene = R"(
name: rooms
walls:
  - {from: [0, 0], to: [6, 0]}
  - {from: [6, 0], to: [6, 3]}
  - {from: [6, 3], to: [0, 3]}
  - {from: [0, 3], to: [0, 0]}
  - {from: [3, 0], to: [3, 3], doors: [{at_m: 1.5}]}
lights:
  - {lamp: [1, 1, 2.4], power: 30, radius_m: 0.2}
robot:
  start: [0.6, 1.5]
)";

class Plan : public testing::Test {
 protected:
  Plan() { writeText(folder_ / "rooms.yaml", kPlanScene); }
  HeelRun plan(const std::string& map, const std::string& to = "5,0.6",
               const std::vector<std::string>& more = {}) {
    return heel({"plan", map, "--from", "1,0.6", "--to", to, "--out", folder_ / "out"}, more);
  }
  nlohmann::json summary() const { return summaryIn(folder_ / "out"); }
  TempFolder folder_;
};

TEST_F(Plan, GoesThroughTheDoorway) {
  const HeelRun run = plan(folder_ / "rooms.yaml");
  ASSERT_TRUE(succeeds(run));
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("found: 4."));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre("path.csv", "plan.png", "summary.json"));
  EXPECT_EQ(summary().at("status"), "found");
  EXPECT_GT(summary().at("length_m"), 4.2);
  EXPECT_LT(summary().at("length_m"), 4.7);
  EXPECT_GE(summary().at("min_clearance_m"), 0.3);
}

TEST_F(Plan, IsAlikeOnEveryKindOfMapOfTheSame) {
  ASSERT_TRUE(succeeds(plan(folder_ / "rooms.yaml")));
  const double length_m = summary().at("length_m");
  ASSERT_TRUE(succeeds(heel({"map", folder_ / "rooms.yaml", "--out", folder_ / "map"})));
  for (const char* map : {"map/map.yaml", "map/walls.bt"}) {
    ASSERT_TRUE(succeeds(plan(folder_ / map))) << map;
    EXPECT_EQ(summary().at("status"), "found") << map;
    EXPECT_NEAR(summary().at("length_m"), length_m, 1e-9) << map;
  }
}

TEST_F(Plan, KnowsTheScenesByTheirNames) {
  const HeelRun run =
      heel({"plan", "home", "--from", "1.5,2", "--to", "2.2,6", "--out", folder_ / "out"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_EQ(summary().at("status"), "found");
}

TEST_F(Plan, PrintsTheWayPointsAndWritesNothingUnasked) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  const HeelRun run = heel({"plan", "rooms.yaml", "--from", "1,0.6", "--to", "5,0.6"});
  std::filesystem::current_path(before);
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, testing::MatchesRegex("found: 4[^\n]+\n  1.00,0.60\n(  [0-9.,]+\n)+"
                                             "  5.00,0.60\n"));
  EXPECT_THAT(filesBelow(folder_.path()), ElementsAre("rooms.yaml"));
}

TEST_F(Plan, SaysWhyThereIsNoPath) {
  const HeelRun wide = plan(folder_ / "rooms.yaml", "5,0.6", {"--radius", "0.5"});
  ASSERT_TRUE(findsNothing(wide));
  EXPECT_THAT(wide.err, HasSubstr("no path: goal unreachable"));
  const HeelRun outside = plan(folder_ / "rooms.yaml", "50,0.6");
  ASSERT_TRUE(findsNothing(outside));
  EXPECT_THAT(outside.err, HasSubstr("no path: goal outside"));
}

TEST_F(Plan, TellsWhatTheMapHasWhereThereIsNoWay) {
  // 6 m x 2 m of free floor with a wall at its left end, and 2 m x 1 m in its middle that nobody
  // has seen: map_server's grey.
  std::string pixels(60 * 20, '\xFE');
  for (std::size_t y = 0; y < 20; ++y) {
    pixels[60 * y] = '\0';
    if (y >= 5 && y < 15) pixels.replace(60 * y + 20, 20, 20, '\xCD');
  }
  writeText(folder_ / "grey.pgm", "P5\n60 20\n255\n" + pixels);
  writeText(folder_ / "grey.yaml",
            "image: grey.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const auto why = [&](const std::string& from, const std::string& to) {
    const HeelRun run =
        heel({"plan", folder_ / "grey.yaml", "--from", from, "--to", to, "--radius", "0.1"});
    EXPECT_TRUE(findsNothing(run));
    return run.err;
  };
  EXPECT_THAT(why("3,1", "5,1"), HasSubstr("start blocked; the map knows nothing at --from"));
  EXPECT_THAT(why("5,1", "3,1"), HasSubstr("goal unreachable; the map knows nothing at --to"));
  EXPECT_THAT(why("0.05,1", "5,1"), HasSubstr("start blocked; something is at --from"));
  EXPECT_THAT(why("5,1", "9,1"), HasSubstr("goal outside; the map goes from 0.0,0.0 to 6.0,2.0"));
}

TEST_F(Plan, NamesWhatIsWrong) {
  EXPECT_TRUE(failsWith(plan("attic"), {"attic", "no such scene"}));
  EXPECT_TRUE(failsWith(plan(folder_ / "none.bt"), {"none.bt", "no such file"}));
  writeText(folder_ / "cut.bt", "# Octomap OcTree binary file\nid OcTree\n");
  EXPECT_TRUE(failsWith(plan(folder_ / "cut.bt"), {"cut.bt", "truncated"}));
  writeText(folder_ / "lone.yaml", "image: none.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_TRUE(failsWith(plan(folder_ / "lone.yaml"), {"none.pgm"}));
  EXPECT_TRUE(failsWith(plan(folder_ / "rooms.yaml", "5"), {"--to"}));
  EXPECT_TRUE(failsWith(plan(folder_ / "rooms.yaml", "5,far"), {"--to", "far"}));
  EXPECT_TRUE(failsWith(plan(folder_ / "rooms.yaml", "nan,1"), {"finite"}));
  EXPECT_TRUE(failsWith(plan(folder_ / "rooms.yaml", "5,1", {"--radius", "0"}), {"--radius"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Plan, SaysThatItCantWrite) {
  writeText(folder_ / "out", "a file, not a folder");
  EXPECT_TRUE(failsWith(plan(folder_ / "rooms.yaml"), {(folder_ / "out").string()}));
}

}  // namespace
}  // namespace heel::test
