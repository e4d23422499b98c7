// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the wall gate is good for: a target among things in the target's colours.
#pragma once

#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/follower/learn_person.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <cstdint>
#include <filesystem>

namespace heel {

/// The scene poster.yaml: two posters and a coat hang on the walls in the colour of the target's
/// top, which is another with each seed. The robot stands still; the target goes out for a while.
struct GateExperimentParams {
  double empty_s = 5.0;   ///< Of the lesson, as in the perception experiment.
  double person_s = 6.0;  ///< The same.
  double follow_s = 20.0;
  AppearanceParams appearance = ofWholeBody();
  PerceptionParams perception;
  std::filesystem::path scenes;  ///< Folder of the scenes that come with Heel.
};

/// What one way of gating gave on a recording.
struct GateOutcome {
  TargetMetrics target;
  double wrong_target_s = 0.0;  ///< Time followed (or coasted) where the target is not.
  double right_target_s = 0.0;  ///< Time followed where the target is in view.
};

struct GateRun {
  std::uint64_t seed = 0;
  GateOutcome with_gate;
  GateOutcome without_gate;
};

/// Deterministic by seed.
/// @throws std::runtime_error  as loadScene(), or if nothing of the person could be learned.
GateRun runGateExperiment(std::uint64_t seed, const GateExperimentParams& params);

}  // namespace heel
