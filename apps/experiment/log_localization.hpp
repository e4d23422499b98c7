// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Localization on a recorded laser log.
#pragma once

#include <heel/apps/recording/laser_log.hpp>
#include <heel/mapping/localization.hpp>

#include <filesystem>
#include <functional>
#include <optional>

namespace heel {

/// Which scans of a log make its map; the others are then localized on it.
enum class MapScans {
  kEven,       ///< Every second.
  kFirstHalf,  ///< The first half, while the second is localized: only fair where it comes back.
  kAll,        ///< All, and all are localized: not a fair test.
};

/// The map that a log's own reference poses give.
/// @throws std::runtime_error  if a scan has no reference; and as openLaserLog().
OccupancyGrid mapFromLog(const std::filesystem::path& log, MapScans which, double cell_size_m,
                         const FloorPose& T_base_scanner, const BagTopics& topics = {});

/// How a log is localized.
struct LogLocalizationParams {
  LocalizationParams localization;
  FloorPose T_base_scanner;
  std::optional<MapScans> left_out;  ///< The scans that made the map; nothing = none.
  bool global = false;               ///< Starts anywhere ...
  std::optional<FloorPose> start;    ///< ... or here, else at the first reference.
  BagTopics topics;                  ///< Of a log that is a bag.
};

/// One localized scan.
struct LogLocalizationStep {
  double stamp_s = 0.0;
  LocalizationEstimate estimate;
  std::optional<FloorPose> reference;
  std::size_t particles = 0;
};

/// All of them together.
struct LogLocalizationResult {
  bool complete = true;  ///< False if a signal ended it before.
  int scans = 0;
  int weighed = 0;  ///< The robot had moved.
  double way_m = 0.0;
  double lost_share = 0.0;
  int compared = 0;  ///< With a reference, and not lost.
  double rms_m = 0.0;
  double rms_rad = 0.0;
  double median_m = 0.0;
  double worst_m = 0.0;
  double odometry_error_m = 0.0;  ///< Of the odometry alone, at the end.
  double first_right_s = -1.0;    ///< Within 0.5 m of the reference and not lost; < 0 = never.
};

/// @param each  Told every step.
/// @param work  Wraps the work of localization, to be timed; must call what it is given.
/// @throws std::runtime_error  as the log; if there is neither a start nor a reference.
LogLocalizationResult localizeLog(const std::filesystem::path& log, const OccupancyGrid& map,
                                  const LogLocalizationParams& params,
                                  const std::function<void(const LogLocalizationStep&)>& each,
                                  const std::function<void(const std::function<void()>&)>& work);

}  // namespace heel
