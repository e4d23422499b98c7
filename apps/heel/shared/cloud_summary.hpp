// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The same done to each of many clouds, and what became of each: summary.csv and summary.json.
#pragma once

#include <heel/apps/heel/shared/ordered_loop.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace heel {

/// What became of one cloud.
struct CloudFate {
  std::string outcome;  ///< One word: "written". "failed" if the cloud could not be worked on.
  std::string reason;   ///< Why it failed or brought nothing: a sentence that names the file.
  CloudFacts facts;     ///< Without a format, if the file could not be read.

  bool hasFailed() const { return outcome == kFailed; }
  static constexpr const char* kFailed = "failed";
  static constexpr const char* kStopped = "stopped";  ///< A signal came before its turn.
};

/// Writes summary.csv row by row: the file, its fate and its facts, and what the verb adds to them.
class CloudSummary {
 public:
  /// @param columns  Those that the verb adds.
  /// @throws OutputError  if a file can't be written; so do the others.
  CloudSummary(const Output& output, const std::vector<std::string>& columns);

  /// @param addFields  Writes the verb's own fields of the row.
  void add(const std::filesystem::path& file, const CloudFate& fate,
           const std::function<void(CsvWriter&)>& addFields);

  std::size_t files() const { return files_; }
  std::size_t failed() const { return count(CloudFate::kFailed); }
  std::size_t count(const std::string& outcome) const;

  /// "5 written, 3 failed", the most frequent first.
  std::string outcomes() const;

  /// Writes summary.json too: how many files met which fate, `more`, and the reasons.
  void close(const nlohmann::ordered_json& more);

 private:
  CsvWriter csv_;
  OutputPath json_;
  std::size_t files_ = 0;
  std::map<std::string, std::size_t> outcomes_;
  nlohmann::ordered_json reasons_ = nlohmann::ordered_json::array();
};

/// "XYZRGB" facts for people to read: "PCD binary_compressed, organized 640x480, fields x y z rgb,
/// 100 % of 307200 points with a place".
std::string toText(const CloudFacts& facts);

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

/// Tells on stderr why clouds failed, a sentence each; then fails, if there were any.
/// @param stopped  So many were not done, because a signal asked for the end.
/// @throws Stopped, std::runtime_error  that counts them.
void tellFailures(const std::vector<std::string>& failures, std::size_t clouds,
                  std::size_t stopped = 0);

/// Calls `work(file index, fate)` for each cloud and takes an error for its fate; adds each result
/// to the summary, in order, by `add(index, fate, result)`. Once a signal asks for the end, the
/// others are passed over, as kStopped.
/// @return  Why clouds failed.
/// @throws OutputError  of `work`: where one result can't be written, others can't.
/// @tparam Work  Returns a result that can be default-constructed: that of a cloud that failed.
template <typename Work, typename Add>
std::vector<std::string> workOnClouds(const std::string& title, std::size_t clouds,
                                      unsigned threads, const Work& work, const Add& add) {
  using Result = decltype(work(std::size_t{}, std::declval<CloudFate&>()));
  std::vector<std::string> failures;
  ProgressBar progress(title, clouds);
  const auto tried = [&](std::size_t i) {
    std::pair<CloudFate, Result> done;
    if (isStopRequested()) {
      done.first.outcome = CloudFate::kStopped;
      return done;
    }
    try {
      done.second = work(i, done.first);
    } catch (const OutputError&) {
      throw;
    } catch (const std::exception& error) {
      done.first.outcome = CloudFate::kFailed;
      done.first.reason = error.what();
      done.second = Result();
    }
    return done;
  };
  loopInOrder(clouds, threads, tried, [&](std::size_t i, std::pair<CloudFate, Result>&& done) {
    if (done.first.hasFailed()) failures.push_back(done.first.reason);
    add(i, done.first, done.second);
    progress.show(i + 1);
  });
  return failures;
}

}  // namespace heel
