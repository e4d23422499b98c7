// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Everyone's model against everyone, on a recording of real people.
#pragma once

#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/experiment/experiments.hpp>

#include <filesystem>
#include <functional>
#include <vector>

namespace heel {

/// The matrix of section 4.1 on a still camera's recording with truth.csv: points near a person's
/// true place in the first half of their exact frames teach their model, the second half tests it.
///
/// Several are in view at once, so a run's `followed` counts the frames in which the confirmed
/// track at the person's place is the model's person with enough probability
/// (TargetParams::take_above): in which they would be taken for the target if they were alone.
/// @throws std::runtime_error  as openRecording() and readTruth().
std::vector<ModelRuns> runPeopleMatrixExperiment(const std::filesystem::path& recording,
                                                 const std::vector<OfferedModel>& models,
                                                 const ExperimentParams& params,
                                                 const std::function<void(double)>& progress = {});

}  // namespace heel
