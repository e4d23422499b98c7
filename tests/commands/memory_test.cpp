// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A recording is streamed: its length does not cost memory.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

namespace heel::test {
namespace {

TEST(Memory, DoesNotGrowWithTheRecording) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps freed memory";
#endif
  const TempFolder folder;
  writeSmallModel(folder / "person.yaml");
  const auto peakOf_kB = [&](int frames, const std::vector<std::string>& more) {
    SmallRecording{2, frames - 2}.write(folder / "room");
    const HeelRun run =
        heel({"track", folder / "room", "--model", folder / "person.yaml", "--out", folder / "out"},
             more);
    EXPECT_TRUE(succeeds(run));
    return run.peak_kB;
  };
  const auto growth_kB = [&](const std::vector<std::string>& more) {
    const long short_kB = peakOf_kB(100, more);
    return peakOf_kB(400, more) - short_kB;
  };
  // The 300 frames more are 40 MB of images and depths, and 500 MB of drawn pictures; of these the
  // film's encoder holds more or fewer, as its threads get on.
  EXPECT_LT(growth_kB({"--no-film"}), 12'000);
  EXPECT_LT(growth_kB({}), 100'000);
}

}  // namespace
}  // namespace heel::test
