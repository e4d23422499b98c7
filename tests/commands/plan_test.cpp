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
    std::vector<std::string> call = {"plan", map, "--from", "1,0.6",
                                     "--to", to,  "--out",  folder_ / "out"};
    call.insert(call.end(), more.begin(), more.end());
    return heel(call);
  }
  nlohmann::json summary() const {
    return nlohmann::json::parse(readText(folder_ / "out/summary.json"));
  }
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

TEST_F(Plan, SaysWhyThereIsNoPath) {
  const HeelRun wide = plan(folder_ / "rooms.yaml", "5,0.6", {"--radius", "0.5"});
  ASSERT_TRUE(findsNothing(wide));
  EXPECT_THAT(wide.err, HasSubstr("no path: goal_unreachable"));
  const HeelRun outside = plan(folder_ / "rooms.yaml", "50,0.6");
  ASSERT_TRUE(findsNothing(outside));
  EXPECT_THAT(outside.err, HasSubstr("no path: goal_outside"));
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
