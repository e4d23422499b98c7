// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Many runs of following as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/results/follow_episodes.hpp>

#include <string>

namespace heel {

/// The whole page, well-formed as XML too, without an address of anything outside of it.
std::string followExperimentPage(const FollowExperiment& experiment);

/// Writes followExperimentPage() to a file.
/// @throws OutputError  as OutputFile.
void writeFollowExperimentPage(const OutputPath& file, const FollowExperiment& experiment);

}  // namespace heel
