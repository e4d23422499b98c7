// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Tracks against truth: what `heel evaluate` reports.
#pragma once

#include <heel/apps/results/result_files.hpp>
#include <heel/tracking/clear_mot.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <string>
#include <vector>

namespace heel {

/// Everything known of one moment, with its people by name.
struct Moment {
  double stamp_s = 0.0;
  std::vector<TruthRow> truth;
  std::vector<TrackRow> tracks;
};

/// Puts tracks and truth side by side, in order of time. Rows belong to one moment when their
/// stamps differ by no more than `tolerance_s`.
///
/// @param frames_s  When frames were looked at, in order: these are the moments then, with somebody
///                  in them or not, and what is at other times is left out. Empty: not known.
std::vector<Moment> alignByStamp(std::vector<TrackRow> tracks, std::vector<TruthRow> truth,
                                 const std::vector<double>& frames_s = {},
                                 double tolerance_s = 0.01);

struct EvaluationParams {
  double match_distance_m = 0.5;
  std::string target;  ///< The person to follow; empty: the first to enter, as in phase 1.
  double from_s = -1e18;
  double to_s = 1e18;  ///< Only moments from `from_s` to `to_s` (both included) count.
};

struct Evaluation {
  std::string target;    ///< Whom the target's figures are about.
  ClearMot people;       ///< All tracks of people against all people.
  int things = 0;        ///< Places of other tracks, which are more likely of things.
  TargetMetrics person;  ///< The target's track against the target.
};

/// @throws std::runtime_error  if there is no truth at all, or none of `params.target`, or if
///                             tracks and truth have no moment in common.
Evaluation evaluate(const std::vector<Moment>& moments, const EvaluationParams& params = {});

}  // namespace heel
