// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel view, without a display.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class View : public testing::Test {
 protected:
  View() { SmallRecording{5, 8}.write(folder_ / "room"); }

  TempFolder folder_;
};

TEST_F(View, WritesPicturesToAFolder) {
  const HeelRun run = heel({"view", folder_ / "room", "--out", folder_ / "out", "--pictures", "4"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("wrote 4 pictures of 13 frames"));
  EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre("view_000001.png", "view_000005.png",
                                                       "view_000009.png", "view_000013.png"));
}

TEST_F(View, WithAModelShowsTheSameBytesEachTime) {
  writeSmallModel(folder_ / "person.yaml");
  for (const char* out : {"a", "b"}) {
    EXPECT_TRUE(succeeds(heel({"view", folder_ / "room", "--model", folder_ / "person.yaml",
                               "--out", folder_ / out, "--pictures", "0"})));
  }
  EXPECT_TRUE(
      succeeds(heel({"view", folder_ / "room", "--out", folder_ / "without", "--pictures", "0"})));
  EXPECT_THAT(filesBelow(folder_ / "a"), SizeIs(13));
  EXPECT_TRUE(contentOf(folder_ / "a") == contentOf(folder_ / "b"));
  EXPECT_FALSE(contentOf(folder_ / "a") == contentOf(folder_ / "without"));
}

TEST_F(View, WithoutADisplayAsksForAFolder) {
  unsetenv("DISPLAY");
  EXPECT_TRUE(failsWith(heel({"view", folder_ / "room"}), {"--out"}));
}

TEST_F(View, OfNoRecordingSaysWhy) {
  EXPECT_TRUE(failsWith(heel({"view", folder_ / "nowhere"}), {"nowhere", "does not exist"}));
}

}  // namespace
}  // namespace heel::test
