// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/cloud/files.hpp>

#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace heel {
namespace {

std::string whyNotFinite(const std::string& text) {
  double value = 0.0;
  const bool is_finite = !CLI::detail::lexical_cast(text, value) || std::isfinite(value);
  return is_finite ? std::string() : "'" + text + "' is not a finite number";
}

/// --threads, for verbs that do not share out their own work: our libraries' threads.
void addThreads(CLI::App& verb) {
  const auto limit = std::make_shared<std::unique_ptr<tbb::global_control>>();
  const std::function<void(const int&)> set = [limit](const int& threads) {
    if (threads == 0) return;
    cv::setNumThreads(threads);
    *limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                   static_cast<std::size_t>(threads));
  };
  verb.add_option_function("--threads", set, "how many threads at once (default: all cores)")
      ->check(CLI::Range(0, 1024))
      ->option_text("N");
}

/// --resume, for verbs that write results.
void addResume(CLI::App& verb) {
  CLI::Option* resume = verb.add_flag(
      "--resume", "do nothing if --out holds the complete results of this very call already");
  verb.parse_complete_callback([&verb, resume] {
    const CLI::Option* out = verb.get_option("--out");
    const CLI::Option* bag = verb.get_option_no_throw("--bag");
    if (resume->empty() || out->empty()) return;
    const auto place = out->as<std::string>();
    if (!isDoneAlready(place)) return;
    if (bag != nullptr && !bag->empty() && !isDoneAlready(bag->as<std::string>())) return;
    std::printf("%s is complete already\n", place.c_str());
    throw CLI::Success();
  });
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
  if (app.get_option_no_throw("--threads") == nullptr) addThreads(app);
  if (app.get_option_no_throw("--out") != nullptr) addResume(app);
  const std::function<void(const std::string&)> show = [](const std::string& style) {
    setProgressStyle(style == "json" ? ProgressStyle::kJson : ProgressStyle::kForPeople);
  };
  app.add_option_function("--progress", show,
                          "how progress is told on stderr: 'bar', or 'json' for programs, an "
                          "object a line (default: bar)")
      ->check(CLI::IsMember({"bar", "json"}))
      ->option_text("HOW");
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
