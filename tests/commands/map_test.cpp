// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel map, and heel inspect of what it wrote.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A room of 4 x 3 m with an inner wall.
constexpr const char* kMapScene = R"(
name: room
walls:
  - {from: [0, 0], to: [4, 0]}
  - {from: [4, 0], to: [4, 3]}
  - {from: [4, 3], to: [0, 3]}
  - {from: [0, 3], to: [0, 0]}
  - {from: [2, 0], to: [2, 3], doors: [{at_m: 1.5}]}
lights:
  - {lamp: [1, 1, 2.4], power: 30, radius_m: 0.2}
people:
  - name: bruno
    start: [3, 1.5]
    outfit: {top: {color: forest}, trousers: {color: charcoal}}
    path: [{wait_s: 1}]
robot:
  start: [0.6, 1.5]
  camera: {at: [0, 0, 1], pitch_deg: 3, width: 320, height: 240, view_deg: 60}
)";

class Map : public testing::Test {
 protected:
  Map() { writeText(folder_ / "room.yaml", kMapScene); }
  HeelRun map(const std::string& source, const std::vector<std::string>& more = {}) {
    return heel({"map", folder_ / source, "--out", folder_ / "out"}, more);
  }
  TempFolder folder_;
};

TEST_F(Map, OfASceneIsWrittenAndInspected) {
  const HeelRun run = map("room.yaml");
  ASSERT_TRUE(succeeds(run));
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("scene, 4.1 x 3.1 m in cells of 0.05 m"));
  EXPECT_THAT(filesBelow(folder_ / "out"),
              ElementsAre("map.pgm", "map.png", "map.yaml", "walls.bt"));
  for (const char* name : {"walls.bt", "map.yaml"}) {
    const HeelRun inspected =
        heel({"inspect", folder_ / "out" / name, "--out", folder_ / "picture.png"});
    EXPECT_TRUE(succeeds(inspected));
    EXPECT_THAT(inspected.out, HasSubstr("4.1 x 3.1 m in cells of 0.05 m"));
    EXPECT_TRUE(std::filesystem::remove(folder_ / "picture.png"));
  }
}

TEST_F(Map, OfAMapIsTheSameMap) {
  ASSERT_TRUE(succeeds(map("room.yaml")));
  const std::string pgm = readText(folder_ / "out/map.pgm");
  for (const char* source : {"map.yaml", "walls.bt"}) {
    const HeelRun run = heel({"map", folder_ / "out" / source, "--out", folder_ / "again"});
    ASSERT_TRUE(succeeds(run));
    EXPECT_TRUE(readText(folder_ / "again/map.pgm") == pgm) << source;
  }
}

TEST_F(Map, OfAPictureNeedsTheSizeOfAPixel) {
  ASSERT_TRUE(succeeds(map("room.yaml")));
  std::filesystem::copy(folder_ / "out/map.pgm", folder_ / "plan.pgm");
  EXPECT_TRUE(failsWith(map("plan.pgm"), {"plan.pgm", "--resolution"}));
  const HeelRun run = map("plan.pgm", {"--resolution", "0.1"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("picture, 8.2 x 6.2 m in cells of 0.10 m"));
}

TEST_F(Map, OfARecordingShowsWhatWasSeen) {
  ASSERT_TRUE(succeeds(heel(
      {"simulate", folder_ / "room.yaml", "--out", folder_ / "recording", "--duration", "0.4"})));
  const HeelRun run = map("recording");
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("recording, "));
  std::filesystem::remove(folder_ / "recording/robot.csv");
  EXPECT_TRUE(failsWith(map("recording"), {"robot.csv is missing"}));
}

TEST_F(Map, NamesWhatIsWrong) {
  EXPECT_TRUE(failsWith(map("none.yaml"), {"none.yaml", "no such file"}));
  EXPECT_TRUE(
      failsWith(heel({"map", "attic", "--out", folder_ / "out"}), {"attic", "no such scene"}));
  writeText(folder_ / "cut.bt", "# Octomap OcTree binary file\nid OcTree\n");
  EXPECT_TRUE(failsWith(map("cut.bt"), {"cut.bt", "truncated"}));
  EXPECT_TRUE(failsWith(heel({"inspect", folder_ / "cut.bt"}), {"cut.bt", "truncated"}));
  writeText(folder_ / "turned.yaml", "image: plan.pgm\nresolution: 0.05\norigin: [0, 0, 1.5]\n");
  EXPECT_TRUE(failsWith(map("turned.yaml"), {"turned.yaml", "turned by 1.5 rad"}));
  EXPECT_TRUE(failsWith(map("room.yaml", {"--low", "2", "--high", "1"}), {"--low"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace heel::test
