// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A verb's work on many clouds: on all cores, with a bar, in order.
#pragma once

#include <heel/apps/heel/shared/cloud_summary.hpp>
#include <heel/apps/heel/shared/ordered_loop.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>

#include <atomic>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace heel {

/// How a batch is run; the same on every verb.
struct CloudBatch {
  std::vector<std::string> names;  ///< Files, folders and patterns; see findClouds().
  unsigned threads = 0;            ///< 0: all cores.
};

/// Adds IN and --threads.
void addCloudBatch(CLI::App& verb, CloudBatch& batch, const std::string& inputs);

/// What each cloud's result is called: its own name, with another ending if one is given.
/// @throws std::invalid_argument  if two would be the same.
std::vector<std::string> resultNames(const std::vector<std::filesystem::path>& clouds,
                                     const std::string& ending = "");

/// Clouds of a batch that could not be worked on.
struct CloudFailures {
  std::vector<std::string> reasons;  ///< A sentence each.
  bool is_ours = false;              ///< A result could not be written.
};

/// Tells on stderr why clouds failed; then fails, if there were any.
/// @param stopped  So many were not done, because a signal asked for the end.
/// @throws Stopped, OutputError, std::runtime_error  that counts them.
void tellFailures(const CloudFailures& failures, std::size_t clouds, std::size_t stopped = 0);

/// Calls `work(file index, fate)` for each cloud and takes an error for its fate; adds each result
/// to the summary, in order, by `add(index, fate, result)`. Once a signal asks for the end, the
/// others are passed over, as kStopped.
/// @tparam Work  Returns a result that can be default-constructed: that of a cloud that failed.
template <typename Work, typename Add>
CloudFailures workOnClouds(const std::string& title, std::size_t clouds, unsigned threads,
                           const Work& work, const Add& add) {
  using Result = decltype(work(std::size_t{}, std::declval<CloudFate&>()));
  CloudFailures failures;
  std::atomic<bool> is_ours{false};
  ProgressBar progress(title, clouds);
  const auto tried = [&](std::size_t i) {
    std::pair<CloudFate, Result> done;
    if (isStopRequested()) {
      done.first.outcome = CloudFate::kStopped;
      return done;
    }
    try {
      done.second = work(i, done.first);
    } catch (const std::exception& error) {
      if (dynamic_cast<const OutputError*>(&error) != nullptr) is_ours = true;
      done.first.outcome = CloudFate::kFailed;
      done.first.reason = error.what();
      done.second = Result();
    }
    return done;
  };
  loopInOrder(clouds, threads, tried, [&](std::size_t i, std::pair<CloudFate, Result>&& done) {
    if (done.first.hasFailed()) failures.reasons.push_back(done.first.reason);
    add(i, done.first, done.second);
    progress.show(i + 1);
  });
  failures.is_ours = is_ours;
  return failures;
}

}  // namespace heel
