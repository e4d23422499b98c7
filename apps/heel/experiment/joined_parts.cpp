// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/experiment/joined_parts.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/cloud/files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

constexpr const char* kSummary = "summary.json";

}  // namespace

std::string sharedOptions(const std::vector<std::filesystem::path>& parts) {
  std::string shared;
  for (const std::filesystem::path& part : parts) {
    const std::filesystem::path file = part / kSummary;
    const auto summary = nlohmann::json::parse(readWholeFile(file), nullptr, false);
    if (!summary.is_object() || !summary.contains("shared") || !summary["shared"].is_string() ||
        summary.value("complete", nlohmann::json()) != true) {
      throw std::runtime_error(file.string() +
                               ": these are no complete results of this experiment");
    }
    const auto of_part = summary["shared"].get<std::string>();
    if (&part != &parts.front() && of_part != shared) {
      throw std::runtime_error(part.string() + ": was made with other options (" + of_part +
                               ") than " + parts.front().string() + " (" + shared + ")");
    }
    shared = of_part;
  }
  return shared;
}

void writePartSummary(const Output& output, const std::string& shared, std::size_t runs) {
  writeJson(output / kSummary,
            {{"complete", !isStopRequested()}, {"runs", runs}, {"shared", shared}});
}

void checkSeeds(const std::vector<std::uint64_t>& seeds) {
  const auto twice = std::adjacent_find(seeds.begin(), seeds.end());
  if (twice != seeds.end()) {
    throw std::runtime_error("two of the parts hold the same run, of seed " +
                             std::to_string(*twice));
  }
  for (std::size_t i = 1; i < seeds.size(); ++i) {
    if (seeds[i] == seeds[i - 1] + 1) continue;
    const std::uint64_t first = seeds[i - 1] + 1, last = seeds[i] - 1;
    tell(first == last
             ? "no part has seed " + std::to_string(first)
             : "no part has the seeds " + std::to_string(first) + " to " + std::to_string(last));
  }
}

}  // namespace heel
