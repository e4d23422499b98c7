// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The experiments, each a subcommand of `heel experiment`.
#pragma once

#include <heel/apps/output/output.hpp>

#include <CLI/App.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// What the experiments on simulated recordings are asked for.
struct SimulatedRuns {
  int recordings = 0;
  std::uint64_t seed = 1;  ///< Of the first; each other has the next.
  std::filesystem::path out = {};
};

/// Adds --recordings, --seed and --out, and finds the folder of the scenes that come with Heel.
void addSimulatedRuns(CLI::App& experiment, SimulatedRuns& runs, std::filesystem::path& scenes);

/// Where an experiment writes; nothing, if `out` is empty.
/// @throws std::invalid_argument, OutputError  as Output.
std::optional<Output> experimentOutput(const std::string& name, const std::filesystem::path& out,
                                       const std::vector<std::filesystem::path>& inputs = {});

/// Gives the results, if any, their place.
/// @throws Stopped  if a signal asked for the end.
void endExperiment(std::optional<Output>& output);

void addAppearanceExperiment(CLI::App& verb);
void addFollowExperiment(CLI::App& verb);
void addGateExperiment(CLI::App& verb);
void addLightExperiment(CLI::App& verb);
void addLocalizationExperiment(CLI::App& verb);
void addPerceptionExperiment(CLI::App& verb);

}  // namespace heel
