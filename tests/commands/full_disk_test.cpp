// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Results for which there is no room.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::ElementsAre;

class FullDisk : public testing::Test {
 protected:
  FullDisk() {
    SmallRecording().write(folder_ / "room");
    writeSmallModel(folder_ / "person.yaml");
    std::filesystem::create_directories(folder_ / "out");
  }

  std::vector<std::string> track(const std::vector<std::string>& options = {}) {
    return joined(
        {"track", folder_ / "room", "--model", folder_ / "person.yaml", "--out", folder_ / "out"},
        options);
  }

  std::vector<std::string> learn() {
    return {"learn", folder_ / "room", "--out", folder_ / "out/model.yaml"};
  }

  TempFolder folder_;
};

TEST_F(FullDisk, LeavesNoTable) {
  EXPECT_TRUE(failsWith(heel(track({"--no-film"}), 3000), {"csv", "cannot be written"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
}

TEST_F(FullDisk, LeavesNoStillAndNoTableWithoutThem) {
  EXPECT_TRUE(failsWith(heel(track(), 30'000), {"frame_", ".png cannot be written"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
}

TEST_F(FullDisk, LeavesNoFilmAndNoTableWithoutIt) {
  EXPECT_TRUE(failsWith(heel(track(), 600'000), {"tracks.mp4 cannot be written"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
}

TEST_F(FullDisk, KeepsTheResultsOfTheRunBefore) {
  ASSERT_TRUE(succeeds(heel(track({"--no-film"}))));
  const auto files = filesBelow(folder_ / "out");
  const std::string timing = readText(folder_ / "out/timing.csv");
  EXPECT_TRUE(failsWith(heel(track({"--no-film"}), 3000), {"cannot be written"}));
  EXPECT_EQ(filesBelow(folder_ / "out"), files);
  EXPECT_EQ(readText(folder_ / "out/timing.csv"), timing);
}

TEST_F(FullDisk, LeavesNoModel) {
  EXPECT_TRUE(failsWith(heel(learn(), 2000), {"cannot be written"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
}

TEST_F(FullDisk, LeavesNoFilteredCloud) {
  std::string text =
      "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2000\n"
      "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2000\nDATA ascii\n";
  for (int i = 0; i < 2000; ++i) {
    const double wave = 0.7548776662 * i;
    text += std::to_string(wave * wave) + " " + std::to_string(1.0 / (1.0 + wave)) + " 1 10000\n";
  }
  writeText(folder_ / "in.pcd", text);
  EXPECT_TRUE(failsWith(heel({"filter", "--negative", "--model", folder_ / "person.yaml",
                              folder_ / "in.pcd", folder_ / "out/out.pcd"},
                             4000),
                        {"out.pcd", "cannot be written"}));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
}

}  // namespace
}  // namespace heel::test
