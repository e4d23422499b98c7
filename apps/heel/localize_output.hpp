// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel localize` writes.
#pragma once

#include "apps/experiment/log_localization.hpp"
#include "apps/report/csv_file.hpp"

#include <filesystem>
#include <vector>

namespace heel {

/// poses.csv, summary.json, and path.png: the ways of the estimate and of the reference on the map.
class LocalizeOutput {
 public:
  /// @param map  Must outlive this.
  /// @throws std::runtime_error  if the folder or a file can't be written; so do the others.
  LocalizeOutput(const std::filesystem::path& folder, const OccupancyGrid& map);

  void add(const LogLocalizationStep& step);
  void finish(const LogLocalizationResult& result, double updates_per_s);

 private:
  void writePicture() const;

  struct Place {
    Eigen::Vector2d estimate;
    bool lost;
    std::optional<Eigen::Vector2d> reference;
  };
  std::filesystem::path folder_;
  const OccupancyGrid& map_;
  CsvWriter poses_;
  std::vector<Place> places_;
};

}  // namespace heel
