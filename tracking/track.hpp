// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A track, the tracker's parameters, and its report of a step.
#pragma once

#include <heel/tracking/geometric_gate.hpp>
#include <heel/tracking/kalman.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

/// How far a track may be from what it explains, and how long it lives.
struct TrackerParams {
  MotionParams motion;
  double position_sigma_m = 0.12;  ///< Standard deviation of an observation's place, per axis.
  /// Standard deviation of a new track's unknown velocity, per axis.
  double start_speed_sigma_mps = 1.0;
  double gate_prob = 0.997;  ///< Share of a track's own observations that its gate lets in.
  /// Bounds the gate: nobody is expected further from where they were seen than they walk at this
  /// speed, and slack_m.
  double max_speed_mps = 2.0;
  double slack_m = 0.5;         ///< Added to the way that max_speed_mps allows.
  double detection_prob = 0.9;  ///< Probability that a person in view is observed in a frame.
  /// Observations from nowhere (newcomers, clutter) per square metre and frame. An observation is
  /// given to a track only where the track explains it better than this.
  double new_density_per_m2 = 0.02;
  /// Of several observations that compete for a track, one whose score is the fraction f of the
  /// best one's pays -score_weight ln(f) on the scale of squared Mahalanobis distances.
  double score_weight = 1.0;
  /// An observation left over this near to a track in view is a fragment of it and starts no track.
  double birth_clearance_m = 0.4;
  /// A track is confirmed when it was seen in this many of its first confirm_frames frames.
  int confirm_hits = 2;
  /// A track that is not confirmed after so many frames (at most 32) is dropped.
  int confirm_frames = 3;
  double max_coast_s = 1.0;  ///< A confirmed track that was not seen for longer is lost.
  double max_gap_s = 2.0;    ///< A longer gap than this between two frames ends all tracks.
};

/// @throws std::invalid_argument  if a parameter is out of range; the text names it.
void checkParams(const TrackerParams& params);

enum class TrackStatus {
  kTentative,  ///< Too young to be believed.
  kConfirmed,  ///< Seen in this frame.
  kCoasting,   ///< Not seen in this frame; its place is predicted.
};
const char* toText(TrackStatus status);

/// One person's track.
struct Track {
  static constexpr int kUnseen = -1;

  int id = 0;  ///< Counts from 1; never used again.
  TrackStatus status = TrackStatus::kTentative;
  MotionState motion;           ///< At the newest frame's stamp.
  double seen_s = 0.0;          ///< Stamp of its newest observation.
  int observation = kUnseen;    ///< Index of the observation it took in the newest frame.
  double density_per_m2 = 0.0;  ///< Of that observation's place, as the track foretold it.
  int hits = 0;                 ///< Observations taken in all.
  double score = 0.0;           ///< Of its newest observation.
  std::uint32_t history = 0;    ///< Bit k: seen k frames ago.
};

/// How a frame's stamp fits the one before.
enum class StepStatus {
  kFirst,    ///< The first frame.
  kRegular,  ///< Later by no more than `max_gap_s`.
  kGap,      ///< Later by more than `max_gap_s`, or earlier by more: all tracks were lost first.
  kSkipped,  ///< Not later, by no more than `max_gap_s`: the frame was ignored.
};

/// What became of an observation.
enum class ObservationFate {
  kIgnored,    ///< The frame was skipped.
  kRejected,   ///< By the geometric gate; see `verdict`.
  kUpdated,    ///< It updated track `track_id`.
  kBorn,       ///< It started track `track_id`.
  kTooLittle,  ///< No track took it, and it can't start one.
  kFragment,   ///< Too close to track `track_id`, which has a better observation.
};
/// What became of an observation, and of which track it is.
struct ObservationUse {
  ObservationFate fate = ObservationFate::kIgnored;
  GateVerdict verdict = GateVerdict::kAccepted;
  int track_id = 0;
};

/// Two tracks whose observations (or whose observation, if one is unseen) may as well be each
/// other's.
struct Swap {
  int track_a = 0, track_b = 0;
  double probability = 0.0;  ///< That they are, of these two ways to share them.
};

/// What happened in a step.
struct TrackerReport {
  StepStatus status = StepStatus::kFirst;
  double dt_s = 0.0;                             ///< Stamp minus the one before; 0 for the first.
  std::array<int, kGateVerdicts> verdicts = {};  ///< Observations by what the gate said.
  int updated = 0;                               ///< Observations by fate.
  int born = 0;
  std::vector<ObservationUse> uses;  ///< One for each observation, in their order.
  std::vector<int> lost;             ///< Ids of confirmed tracks that ended.
  std::vector<Swap> swaps;           ///< That are not improbable.

  int verdictCount(GateVerdict verdict) const {
    return verdicts[static_cast<std::size_t>(verdict)];
  }
};

}  // namespace heel
