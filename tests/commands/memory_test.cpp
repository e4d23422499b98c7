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
  const auto peakOf_kB = [&](int frames) {
    SmallRecording{2, frames - 2}.write(folder / "room");
    const HeelRun run = heel(
        {"track", folder / "room", "--model", folder / "person.yaml", "--out", folder / "out"});
    EXPECT_TRUE(succeeds(run));
    return run.peak_kB;
  };
  const long short_kB = peakOf_kB(100);  // the film's encoder holds some 50 pictures
  const long long_kB = peakOf_kB(400);
  RecordProperty("short_kB", std::to_string(short_kB));
  RecordProperty("long_kB", std::to_string(long_kB));
  // The 300 frames more are 40 MB of images and depths, and 500 MB of drawn pictures.
  EXPECT_LT(long_kB, short_kB + 12'000) << short_kB << " kB for the short one";
}

}  // namespace
}  // namespace heel::test
