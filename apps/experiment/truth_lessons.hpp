// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Everyone of a recording learned from where they truly were.
#pragma once

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/model_lessons.hpp>
#include <heel/apps/experiment/truth_frames.hpp>

#include <filesystem>
#include <vector>

namespace heel {

/// What the points near each person's true place, in the first half of the frames where it is
/// exact, and the empty scene teach of them. In the order of truth.people().
std::vector<ModelLessons> learnEveryone(const std::filesystem::path& recording,
                                        const CameraSetup& setup, const TruthFrames& truth,
                                        const std::vector<OfferedModel>& models,
                                        const ExperimentParams& params);

}  // namespace heel
