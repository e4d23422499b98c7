// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/cloud/file_limits.hpp>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

namespace heel {
namespace {

std::string whyNotFinite(const std::string& text) {
  double value = 0.0;
  const bool is_finite = !CLI::detail::lexical_cast(text, value) || std::isfinite(value);
  return is_finite ? std::string() : "'" + text + "' is not a finite number";
}

}  // namespace

void warn(const std::string& warning) { tell("warning: " + warning); }

void completeVerbs(CLI::App& app) {
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  for (CLI::App* verb : verbs) completeVerbs(*verb);
  if (!verbs.empty()) return;
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().rfind("FLOAT", 0) == 0) option->check(whyNotFinite);
  }
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
