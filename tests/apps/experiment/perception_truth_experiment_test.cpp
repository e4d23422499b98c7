// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/experiment/short_trial.hpp"
#include <heel/apps/experiment/perception_truth_experiment.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace heel {
namespace {

PerceptionTruthRun counted(int factor) {
  PerceptionTruthRun run;
  run.filter = {40 * factor, 30 * factor, 50 * factor, 25 * factor};
  run.target.frames_in_view = 10 * factor;
  run.target.right = 9 * factor;
  run.target.wrong_target_s = 0.5 * factor;
  run.mot.truths = 10 * factor;
  run.mot.matches = 9 * factor;
  run.mot.misses = factor;
  return run;
}

TEST(PixelCount, DividesByWhatPassedAndByWhatWasWanted) {
  const PixelCount count = counted(1).filter;
  EXPECT_DOUBLE_EQ(count.precision(), 0.75);
  EXPECT_DOUBLE_EQ(count.recall(), 0.5);
  EXPECT_TRUE(std::isnan(PixelCount().precision()));
  EXPECT_TRUE(std::isnan(PixelCount().recall()));
}

TEST(PerceptionTruth, SumsCountsNotShares) {
  const PerceptionTruthRun sum = sumOf({counted(1), counted(3)});
  EXPECT_EQ(sum.filter.passed, 160);
  EXPECT_DOUBLE_EQ(sum.filter.recall(), 0.5);
  EXPECT_DOUBLE_EQ(sum.target.recall(), 0.9);
  EXPECT_DOUBLE_EQ(sum.target.wrong_target_s, 2.0);
  EXPECT_DOUBLE_EQ(sum.mot.mota(), 0.9);
}

TEST(PerceptionTruth, FollowsTheTargetNotTheOther) {
  const PerceptionTruthRun run = runPerceptionTruthExperiment(4, test::shortTrial());
  EXPECT_FALSE(run.similar);
  EXPECT_GT(run.target.frames_in_view, 10);
  EXPECT_GT(run.target.recall(), 0.7);
  EXPECT_EQ(run.target.wrong_person, 0);
  EXPECT_LT(run.target.meanError_m(), 0.2);
  EXPECT_GT(run.filter.recall(), 0.7);
  EXPECT_LE(run.standing.found, run.filter.found);  // Each stage only takes away.
  EXPECT_GT(run.standing.precision(), run.filter.precision());
}

}  // namespace
}  // namespace heel
