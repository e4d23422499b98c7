// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The experiments, each a subcommand of `heel experiment`.
#pragma once

#include <CLI/App.hpp>

namespace heel {

void addAppearanceExperiment(CLI::App& verb);
void addFollowExperiment(CLI::App& verb);
void addGateExperiment(CLI::App& verb);
void addLocalizationExperiment(CLI::App& verb);
void addPerceptionExperiment(CLI::App& verb);

}  // namespace heel
