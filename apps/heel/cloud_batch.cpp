// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/cloud_batch.hpp"

#include "apps/report/terminal.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <set>

namespace heel {

namespace fs = std::filesystem;

void addCloudBatch(CLI::App& verb, CloudBatch& batch, const std::string& inputs) {
  verb.add_option("IN", batch.names, inputs)->required();
  verb.add_option("--threads", batch.threads, "how many clouds at once; 0: as many as cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

std::vector<fs::path> resultNames(const std::vector<fs::path>& clouds, const fs::path& folder,
                                  const std::string& ending) {
  std::set<fs::path> inputs, taken;
  for (const fs::path& cloud : clouds) inputs.insert(fs::weakly_canonical(cloud));
  std::vector<fs::path> results;
  for (const fs::path& cloud : clouds) {
    fs::path result = folder / cloud.filename();
    result += ending;
    if (inputs.count(fs::weakly_canonical(result)) > 0) {
      throw std::runtime_error(result.string() + ": would overwrite a cloud that is read");
    }
    if (!taken.insert(result).second) {
      throw std::runtime_error(cloud.string() + ": another cloud's result has the same name, " +
                               result.string());
    }
    results.push_back(std::move(result));
  }
  return results;
}

void removeFormer(const fs::path& result) {
  std::error_code ignored;
  if (!fs::is_directory(result, ignored)) fs::remove(result, ignored);
}

void tellFailures(const std::vector<std::string>& reasons, std::size_t clouds) {
  if (reasons.empty()) return;
  for (const std::string& reason : reasons) {
    std::fprintf(stderr, "heel: %s\n", sentenceForTerminal(reason).c_str());
  }
  throw std::runtime_error(std::to_string(reasons.size()) + " of " + std::to_string(clouds) +
                           " clouds failed; the others are done");
}

}  // namespace heel
