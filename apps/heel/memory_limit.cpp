// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/commands.hpp"
#include "cloud/file_limits.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>

namespace heel {

void addMemoryLimit(CLI::App& app) {
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  for (CLI::App* verb : verbs) addMemoryLimit(*verb);
  if (!verbs.empty()) return;
  const std::function<void(const std::uint64_t&)> set = [](const std::uint64_t& bytes) {
    setMemoryLimit(bytes);
  };
  app.add_option_function("--max-memory", set,
                          "the most memory that may be used, as 4GB (default: no limit; but a file "
                          "may not ask for more than 512 MiB, or 64 times its size, at once)")
      ->transform(CLI::AsSizeValue(false))
      ->option_text("SIZE");
}

}  // namespace heel
