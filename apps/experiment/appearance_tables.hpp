// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The runs of the appearance experiment as tables, to be read again.
#pragma once

#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/output/output.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// Writes people.csv (what each wears, and how they were learned; of simulated people), runs.csv
/// (one line a run) and pairs.csv (one a two-people test).
/// @param folder  Of the output: they go there.
/// @throws OutputError  as CsvWriter.
void writeAppearanceTables(const Output& output, const std::string& folder,
                           const std::vector<WardrobeRuns>& wardrobes, double min_share);

/// Reads them, in the order in which they were written.
/// @throws std::runtime_error  that names the file and what is wrong with it.
std::vector<WardrobeRuns> readAppearanceTables(const std::filesystem::path& folder);

}  // namespace heel
