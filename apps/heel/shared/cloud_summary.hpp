// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What became of each of many clouds: summary.csv and summary.json.
#pragma once

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

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

}  // namespace heel
