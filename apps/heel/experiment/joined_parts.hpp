// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Results of an experiment that was made in parts, each of other seeds. The summary of each part
/// says which options its runs share, and that it is complete.
#pragma once

#include <heel/apps/output/output.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// The options that the runs of all parts share.
/// @throws std::runtime_error  if they differ, or a part is no complete result.
std::string sharedOptions(const std::vector<std::filesystem::path>& parts);

/// Writes what sharedOptions() reads.
void writePartSummary(const Output& output, const std::string& shared, std::size_t runs);

/// Tells on stderr of seeds that are missing.
/// @param seeds  Of all parts, sorted.
/// @throws std::runtime_error  if one is there twice.
void checkSeeds(const std::vector<std::uint64_t>& seeds);

/// Puts the runs of all parts in the order of their `seed`, and checks these.
template <typename Run>
void sortBySeed(std::vector<Run>& runs) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.seed < b.seed; });
  std::vector<std::uint64_t> seeds;
  for (const Run& run : runs) seeds.push_back(run.seed);
  checkSeeds(seeds);
}

}  // namespace heel
