// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel localize` writes.
#pragma once

#include <heel/apps/experiment/log_localization.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/pages.hpp>

#include <filesystem>
#include <vector>

namespace heel {

/// poses.csv, summary.json, and report.html: the ways of the estimate and of the reference.
class LocalizeOutput {
 public:
  /// @param map  Must outlive this.
  /// @param inputs  What is read, the log first: it is not written over.
  /// @throws std::invalid_argument  if it may not be written there, see Output.
  /// @throws OutputError  if it can't be; so do the others.
  LocalizeOutput(const std::filesystem::path& folder, const OccupancyGrid& map,
                 const std::vector<std::filesystem::path>& inputs);

  void add(const LogLocalizationStep& step);
  /// Writes the summary and the report, and gives all files their place.
  void commit(const LogLocalizationResult& result, double updates_per_s);

  /// Where commit() wrote.
  const std::filesystem::path& folder() const { return output_.path(); }

 private:
  Output output_;
  const OccupancyGrid& map_;
  CsvWriter poses_;
  LocalizedLog log_;
};

}  // namespace heel
