// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the experiments on simulated recordings are tested with.
#pragma once

#include <heel/apps/experiment/perception_truth_experiment.hpp>

namespace heel::test {

/// Long enough to learn a person and to see them among others.
inline PerceptionTruthParams shortTrial() {
  PerceptionTruthParams params;
  params.empty_s = 2.0;
  params.person_s = 4.0;
  params.follow_s = 5.0;
  params.scenes = HEEL_SOURCE_DIR "/apps/scenes";
  return params;
}

}  // namespace heel::test
