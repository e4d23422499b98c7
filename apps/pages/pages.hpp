// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The reports, each as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/pages/run_page.hpp>
#include <heel/apps/results/follow_episodes.hpp>
#include <heel/apps/results/follow_log.hpp>
#include <heel/apps/results/run_table.hpp>
#include <heel/apps/results/track_log.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Whether an outcome ("reached", "failed", ...) is good, bad or neither.
Tone toneOf(const std::string& outcome);

/// The whole page, well-formed as XML too. It has no address of anything outside of it but the
/// film's, and is complete without.
std::string followPage(const FollowLog& log, const FollowSummary& summary,
                       const PageFilm& film = {});

/// Writes followPage() to a file.
/// @throws OutputError  as OutputFile.
void writeFollowPage(const OutputPath& file, const FollowLog& log, const FollowSummary& summary,
                     const PageFilm& film = {});

/// The whole page, well-formed as XML too, without an address of anything outside of it.
std::string followExperimentPage(const FollowExperiment& experiment);

/// Writes followExperimentPage() to a file.
/// @throws OutputError  as OutputFile.
void writeFollowExperimentPage(const OutputPath& file, const FollowExperiment& experiment);

/// One localized scan, in the map's frame.
struct LocalizedMoment {
  double stamp_s = 0.0;
  FloorPose estimate;
  double std_m = kNotKnown;  ///< Standard deviation of its place.
  double fit = kNotKnown;    ///< Share of the beams that fit the map.
  std::string state;         ///< "found" or "lost".
  std::optional<FloorPose> reference;
};

/// A whole log, and its figures; NaN stands for what is not known.
struct LocalizedLog {
  std::string name;
  bool complete = true;
  double way_m = kNotKnown;
  double lost_share = kNotKnown;
  double rms_m = kNotKnown;  ///< Against the reference while not lost, as the others.
  double rms_deg = kNotKnown;
  double median_m = kNotKnown;
  double worst_m = kNotKnown;
  std::vector<LocalizedMoment> moments;
};

/// The whole page, well-formed as XML too; the same log gives the same bytes.
std::string localizePage(const LocalizedLog& log, const OccupancyGrid& map);

/// Which runs are shown as the worst.
struct WorstRuns {
  std::string column;         ///< A figure of the table; empty: none are shown.
  bool highest_first = true;  ///< Whether much of it is bad.
  std::size_t count = 12;
};

/// The whole page, well-formed as XML too, without an address of anything outside of it: what
/// failed and why, how the figures are spread, and the worst runs with a picture and the call that
/// shows them again.
std::string summaryPage(const RunTable& table, const WorstRuns& worst);

/// The whole page: where the target was and when, why it was not seen, who else was there, and by
/// what it was known. Well-formed as XML too; the same log gives the same bytes.
std::string trackPage(const TrackLog& log, const PageFilm& film = {});

}  // namespace heel
