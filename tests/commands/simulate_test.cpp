// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel simulate, on a scene that is quickly rendered.

#include "tests/commands/hall_scene.hpp"
#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class Simulate : public testing::Test {
 protected:
  Simulate() {
    writeText(folder_ / "hall.yaml",
              hallScene("0.5", R"({name: bruno, height_m: 1.8, start: [3, 0], yaw_deg: 180,
     outfit: {top: {color: forest}, trousers: {color: charcoal}}, path: [{wait_s: 1}]})",
                        "{at: [0, 0, 1], pitch_deg: 3, width: 320, height: 240, view_deg: 60}"));
  }

  HeelRun simulate(const std::string& out, const std::string& seed = "1") {
    return heel({"simulate", folder_ / "hall.yaml", "--out", folder_ / out, "--seed", seed});
  }

  TempFolder folder_;
};

TEST_F(Simulate, WritesARecordingThatTheOtherVerbsRead) {
  const HeelRun run = simulate("hall");
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(filesBelow(folder_ / "hall"),
              IsSupersetOf({"camera.yaml", "left/000001.png", "right/000001.png", "stereo.yaml",
                            "times.txt", "truth.csv"}));
  const HeelRun inspected = heel({"inspect", folder_ / "hall", "--out", folder_ / "hall.png"});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out, HasSubstr("320x240"));
  EXPECT_THAT(inspected.out, HasSubstr("camera 1.00 m over the floor"));
}

TEST_F(Simulate, GivesTheSameBytesForTheSameSeed) {
  ASSERT_TRUE(succeeds(simulate("first")));
  ASSERT_TRUE(succeeds(simulate("second")));
  const auto files = filesBelow(folder_ / "first");
  ASSERT_EQ(filesBelow(folder_ / "second"), files);
  for (const std::string& file : files) {
    EXPECT_TRUE(readText(folder_ / "first" / file) == readText(folder_ / "second" / file)) << file;
  }
}

TEST_F(Simulate, RefusesAFolderThatHoldsSomething) {
  writeText(folder_ / "hall/letter.txt", "dear");
  EXPECT_TRUE(failsWith(simulate("hall"), {"hall"}));
  EXPECT_THAT(filesBelow(folder_ / "hall"), testing::ElementsAre("letter.txt"));
}

TEST_F(Simulate, NamesASceneThatIsNotThere) {
  EXPECT_TRUE(failsWith(heel({"simulate", "attic", "--out", folder_ / "attic"}),
                        {"attic", "no such scene"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "attic"));
}

}  // namespace
}  // namespace heel::test
