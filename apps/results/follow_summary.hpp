// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The figures of a run of following, and its result files.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <filesystem>
#include <string>

namespace heel {

/// The figures of a run. Learning (states "learn") is left out of all of them but `learn_s`.
///
/// A sample stands for the time until the next one; the last one for none. What can't be told is
/// NaN. The paper's columns are `distance_m`, `elapsed_s`, `seek_s` and `moving_speed_mps`.
struct FollowSummary {
  std::string outcome;
  double learn_s = 0.0;
  double elapsed_s = 0.0;
  double seek_s = 0.0;                   ///< In states that look for the person: see isSeeking().
  double distance_m = 0.0;               ///< Length of the robot's true path.
  double moving_speed_mps = kNotKnown;   ///< distance_m / (elapsed_s - seek_s), as in Table 1.
  double driving_speed_mps = kNotKnown;  ///< Over the time in which the wheels really drive.
  double best_distance_m = kNotKnown;    ///< Least distance to the person.
  double last_distance_m = kNotKnown;    ///< Distance to the person at the end.
  double with_target_s = 0.0;            ///< With an estimate of the target's place.
  double wrong_person_s = 0.0;
  int losses = 0;                      ///< Of the target; see targetEvents().
  int contacts = 0;                    ///< Separate ones: from a touch until it ends.
  int contacts_by_robot = 0;           ///< In which the robot moved towards what it touched.
  double min_clearance_m = kNotKnown;  ///< 0 in contact.
  double localized_s = 0.0;            ///< The next two are over this time.
  double position_rms_m = kNotKnown;   ///< Of the estimated against the true pose.
  double yaw_rms_rad = kNotKnown;
  double person_error_rms_m = kNotKnown;  ///< Of the target's estimate, while it is the person's.
  /// Of a shadow: root mean squares of what it would have driven against what the robot did.
  double command_off_mps = kNotKnown;
  double command_off_radps = kNotKnown;
  double candidate_share = kNotKnown;  ///< Mean over the pictures: pixels of the target's colours.

  double seekShare() const { return elapsed_s > 0.0 ? seek_s / elapsed_s : 0.0; }
  int contactsByPeople() const { return contacts - contacts_by_robot; }
  double wrongShare() const { return elapsed_s > 0.0 ? wrong_person_s / elapsed_s : 0.0; }
};

/// Whether the state is one of those that look for a lost person: "seek" (turning, the paper's
/// seek time) and "search" (driving to where they can have gone). Driving to where they were last
/// seen is on the way, and does not count, as in the paper.
bool isSeeking(const std::string& state);

FollowSummary summarize(const FollowLog& log);

/// A row of the paper's Table 1.
struct PaperRow {
  const char* name;
  double distance_m, elapsed_s, seek_s, moving_speed_mps;
};

/// A run's figures as such a row.
PaperRow paperRow(const FollowSummary& summary, const char* name = "");

extern const std::array<PaperRow, 3> kPaperTable1;

/// The summary as it stands in summary.json; what is not finite is null. A run that was stopped is
/// not "complete".
nlohmann::ordered_json followJson(const FollowLog& log, const FollowSummary& summary);

/// Writes summary.json, follow.csv and timing.csv of a run. The same run gives the same bytes; only
/// timing.csv depends on the machine.
/// @throws OutputError  as OutputFile.
void writeFollowFiles(const Output& output, const FollowLog& log, const FollowSummary& summary);

}  // namespace heel
