// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/cloud_batch.hpp>
#include <heel/apps/heel/shared/terminal.hpp>

#include <CLI/CLI.hpp>

#include <set>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

void addCloudBatch(CLI::App& verb, CloudBatch& batch, const std::string& inputs) {
  verb.add_option("IN", batch.names, inputs)->required();
  verb.add_option("--threads", batch.threads, "how many clouds at once; 0: as many as cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

std::vector<std::string> resultNames(const std::vector<fs::path>& clouds,
                                     const std::string& ending) {
  std::set<std::string> taken;
  std::vector<std::string> results;
  for (const fs::path& cloud : clouds) {
    std::string result = cloud.filename().string() + ending;
    if (!taken.insert(result).second) {
      throw std::invalid_argument(cloud.string() + ": another cloud's result has the same name, " +
                                  result);
    }
    results.push_back(std::move(result));
  }
  return results;
}

void tellFailures(const CloudFailures& failures, std::size_t clouds, std::size_t stopped) {
  for (const std::string& why : failures.reasons) tell(why);
  const std::string of = " of " + std::to_string(clouds) + " clouds ";
  if (stopped > 0) throw Stopped("stopped: " + std::to_string(stopped) + of + "are not done");
  if (failures.reasons.empty()) return;
  const std::string what =
      std::to_string(failures.reasons.size()) + of + "failed; the others are done";
  if (failures.is_ours) throw OutputError(what);
  throw std::runtime_error(what);
}

}  // namespace heel
