// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel localize: calls that can't be met. What heel inspect tells of such logs.

#include "tests/commands/heel.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

class Localize : public testing::Test {
 protected:
  HeelRun localize(const std::string& log, const std::vector<std::string>& more = {}) {
    return heel({"localize", folder_ / log, "--out", folder_ / "out"}, more);
  }
  TempFolder folder_;
};

TEST_F(Localize, NamesALogThatIsNone) {
  EXPECT_TRUE(failsWith(localize("none.log"), {"none.log"}));
  EXPECT_TRUE(failsWith(localize("none.log", {"--map", "home"}), {"none.log"}));
  writeText(folder_ / "empty.log", "");
  EXPECT_TRUE(failsWith(localize("empty.log"), {"empty.log"}));
  writeText(folder_ / "noise.log.gz", "this is not compressed");
  EXPECT_TRUE(failsWith(localize("noise.log.gz"), {"noise.log.gz"}));
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_TRUE(failsWith(localize("folder"), {"folder"}));
}

TEST_F(Localize, NamesAMapThatIsNone) {
  writeText(folder_ / "some.log", "");
  EXPECT_TRUE(failsWith(localize("some.log", {"--map", "attic"}), {"attic"}));
  EXPECT_TRUE(failsWith(localize("some.log", {"--map", folder_ / "none.yaml"}), {"none.yaml"}));
  writeText(folder_ / "lone.yaml", "image: none.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  EXPECT_TRUE(failsWith(localize("some.log", {"--map", folder_ / "lone.yaml"}), {"none.pgm"}));
}

TEST_F(Localize, WarnsOfAMapOfAnotherPlace) {
  ASSERT_TRUE(
      succeeds(heel({"simulate", "corridor", "--duration", "2", "--out", folder_ / "corridor"})));
  const HeelRun right = localize("corridor", {"--map", "corridor"});
  EXPECT_TRUE(succeeds(right));
  EXPECT_THAT(right.err, testing::Not(testing::HasSubstr("warning")));
  const HeelRun wrong = localize("corridor", {"--map", "home"});
  EXPECT_TRUE(succeeds(wrong));
  EXPECT_THAT(wrong.err, testing::HasSubstr("is this the map of its place?"));
}

TEST_F(Localize, InspectTellsWhatIsInALog) {
  writeText(folder_ / "two.log",
            "# a comment\nFLASER 3 2.0 2.0 2.0 0.2 0 0 0 0 0 1.5 host 1.5\n"
            "FLASER 3 2.0 2.0 2.0 3.2 4 0 3 4 0 3.5 host 3.5\n");
  const HeelRun run = heel({"inspect", folder_ / "two.log"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, testing::HasSubstr("2 scans over 2.0 s, 5.0 m"));
  EXPECT_THAT(run.out, testing::HasSubstr("3 beams, 90.00 degrees apart, from -90.0 degrees"));
  EXPECT_THAT(run.out, testing::HasSubstr("scanner at (0.200, 0.000) m"));
  writeText(folder_ / "none.log", "no scans here\n");
  EXPECT_TRUE(failsWith(heel({"inspect", folder_ / "none.log"}), {"none.log", "FLASER"}));
}

}  // namespace
}  // namespace heel::test
