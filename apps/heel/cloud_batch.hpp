// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A verb's work on many clouds: on all cores, with a bar, in order.
#pragma once

#include "apps/clouds/cloud_summary.hpp"
#include "apps/clouds/ordered_loop.hpp"
#include "apps/report/progress_bar.hpp"

#include <filesystem>
#include <stdexcept>
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

/// Where each cloud's result goes: its own name in the folder, with another ending if one is given.
/// @throws std::runtime_error  if two would be the same file, or one of the clouds is written over.
std::vector<std::filesystem::path> resultNames(const std::vector<std::filesystem::path>& clouds,
                                               const std::filesystem::path& folder,
                                               const std::string& ending = "");

/// Tells on stderr why clouds failed, a sentence each; then fails, if there were any.
/// @throws std::runtime_error  that counts them.
void tellFailures(const std::vector<std::string>& reasons, std::size_t clouds);

/// Removes the result that a former run left, where there is no new one.
void removeFormer(const std::filesystem::path& result);

/// Calls `work(file index, fate)` for each cloud and takes an error for its fate; adds each result
/// to the summary, in order, by `add(index, fate, result)`.
/// @tparam Work  Returns a result that can be default-constructed: that of a cloud that failed.
/// @return the reasons of those that failed.
template <typename Work, typename Add>
std::vector<std::string> workOnClouds(const std::string& title, std::size_t clouds,
                                      unsigned threads, const Work& work, const Add& add) {
  using Result = decltype(work(std::size_t{}, std::declval<CloudFate&>()));
  std::vector<std::string> reasons;
  ProgressBar progress(title, clouds);
  const auto tried = [&work](std::size_t i) {
    std::pair<CloudFate, Result> done;
    try {
      done.second = work(i, done.first);
    } catch (const std::exception& error) {
      done.first.outcome = CloudFate::kFailed;
      done.first.reason = error.what();
      done.second = Result();
    }
    return done;
  };
  loopInOrder(clouds, threads, tried, [&](std::size_t i, std::pair<CloudFate, Result>&& done) {
    if (done.first.hasFailed()) reasons.push_back(done.first.reason);
    add(i, done.first, done.second);
    progress.show(i + 1);
  });
  return reasons;
}

}  // namespace heel
