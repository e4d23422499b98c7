// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/gate_experiment.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

TEST(GateExperiment, FollowsTheTargetAmongPostersOfItsColour) {
  GateExperimentParams params;
  params.scenes = HEEL_SOURCE_DIR "/apps/scenes";
  params.follow_s = 6.0;
  const GateRun run = runGateExperiment(3, params);
  for (const auto& seen : {run.with_gate, run.without_gate}) {
    EXPECT_LT(seen.wrong_target_s, 0.5);
    EXPECT_GT(seen.right_target_s, 4.0);
  }
}

}  // namespace
}  // namespace heel
