// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/gate_experiment.hpp"

#include <gtest/gtest.h>

namespace heel {
namespace {

TEST(GateExperiment, FollowsTheTargetAmongPostersOfItsColourOnlyWithTheGate) {
  GateExperimentParams params;
  params.scenes = HEEL_SOURCE_DIR "/apps/scenes";
  params.follow_s = 6.0;
  const GateRun run = runGateExperiment(3, params);
  EXPECT_GT(run.without_gate.wrong_target_s, 1.0);
  EXPECT_LT(run.with_gate.wrong_target_s, 0.5);
  EXPECT_GT(run.with_gate.right_target_s, run.without_gate.right_target_s + 1.0);
}

}  // namespace
}  // namespace heel
