// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What docs/results.md says of real people, as bounds that a change must not break.

#include "tests/support/data.hpp"
#include <heel/apps/experiment/experiments.hpp>

#include <gtest/gtest.h>

#include <iostream>

namespace heel {
namespace {

TEST(ExperimentsOnRealPeople, PhaseOneDetectsEveryone) {
  HEEL_NEED_DATA("six_people");
  int started = 0, stopped = 0;
  WorkTimer timer;
  timer.start = [&] { ++started; };
  timer.stop = [&] { ++stopped; };
  const ClearMot result = runDetectorExperiment(test::dataFolder() / "six_people", {}, timer);
  EXPECT_EQ(result.truths, 226);
  EXPECT_GE(result.moda(), 0.85);
  EXPECT_EQ(started, result.frames);
  EXPECT_EQ(stopped, result.frames);
}

TEST(ExperimentsOnRealPeople, TheFirstPersonIsFollowedByTheirLooks) {
  HEEL_NEED_DATA("six_people");
  HEEL_NEED_DATA("one_person");
  const ProtocolResult result = runProtocolExperiment(test::dataFolder() / "six_people", {});
  EXPECT_EQ(result.person, "navy_jumper");
  EXPECT_EQ(result.following.frames_in_view, 22);
  EXPECT_GE(result.following.recall(), 0.9);
  EXPECT_EQ(result.following.wrongPersonShare(), 0.0);

  const TargetMetrics again = runFollowingExperiment(test::dataFolder() / "one_person",
                                                     result.learned.model, result.person);
  EXPECT_EQ(again.frames_in_view, 38);
  EXPECT_GE(again.recall(), 0.75) << "it takes a few looks to be sure of him";
  EXPECT_EQ(again.wrongPersonShare(), 0.0);
  std::cout << "six_people: recall " << result.following.recall() << "; one_person: recall "
            << again.recall() << "\n";
}

TEST(ExperimentsOnRealPeople, EachOfTheSixIsFollowedOnceStartedOn) {
  HEEL_NEED_DATA("six_people");
  int frames = 0, right = 0, wrong = 0;
  const auto results = runTargetsExperiment({test::dataFolder() / "six_people"}, {});
  EXPECT_EQ(results.size(), 6U);
  for (const TargetResult& result : results) {
    frames += result.started.frames_in_view;
    right += result.started.right;
    wrong += result.started.wrong_person;
  }
  EXPECT_EQ(frames, 106);
  EXPECT_GE(right, 0.8 * frames);
  EXPECT_LE(wrong, 0.1 * frames);
  std::cout << "started on the person: recall " << static_cast<double>(right) / frames
            << ", wrong person " << static_cast<double>(wrong) / frames << "\n";
}

TEST(ExperimentsOnRealPeople, WhoIsInTwoRecordingsIsLookedForInTheOther) {
  HEEL_NEED_DATA("corridor_1");
  HEEL_NEED_DATA("corridor_2");
  const std::filesystem::path one = test::dataFolder() / "corridor_1";
  const std::filesystem::path two = test::dataFolder() / "corridor_2";
  const auto results = runTargetsExperiment({one, two}, {});
  ASSERT_EQ(results.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(results[i].learned_in, i < 2 ? one : two);
    EXPECT_EQ(results[i].sought_in, i < 2 ? two : one);
    EXPECT_GE(results[i].started.recall(), 0.8) << results[i].person;
    EXPECT_EQ(results[i].cold.wrong_person, 0) << results[i].person;
  }
}

}  // namespace
}  // namespace heel
