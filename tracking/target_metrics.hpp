// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How well one target person was followed.
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace heel {

/// A frame of a recording with truth: where people are, and where the target was said to be.
struct TargetFrame {
  double stamp_s = 0.0;
  std::optional<Eigen::Vector2d> target_m;    ///< The target's true place; none: not in view.
  std::vector<Eigen::Vector2d> others_m;      ///< The true places of everyone else in view.
  std::optional<Eigen::Vector2d> estimate_m;  ///< Where the target was said to be, if anywhere.
  /// The place that is likeliest to be the target's, and how likely it is said to be.
  std::optional<Eigen::Vector2d> likeliest_m;
  double probability = 0.0;
};

/// Whom a frame's estimate is of.
enum class EstimateOf {
  kNone,         ///< There is no estimate.
  kTarget,       ///< Within the distance of the target, even if somebody else is near as well.
  kWrongPerson,  ///< Not the target: within the distance of somebody else.
  kNobody,       ///< Within the distance of nobody.
};

/// @throws std::invalid_argument  unless the distance is positive.
EstimateOf judge(const TargetFrame& frame, double match_distance_m = 0.5);

/// Whether what is said to be so with a probability is so as often as that.
struct Reliability {
  /// What was said with probabilities of one tenth of [0, 1].
  struct Bin {
    int count = 0;
    int right = 0;
    double said = 0.0;  ///< Sum of the probabilities.
  };
  std::array<Bin, 10> bins;

  /// @throws std::invalid_argument  unless the probability is in [0, 1].
  void add(double probability, bool is_so);
  void add(const Reliability& other);
  /// Expected calibration error: how far off a bin's mean probability is, weighed by count.
  double expectedError() const;
  /// What it would be in the mean if the probabilities were exact, by chance: for as many frames,
  /// each for itself. Frames are alike, so chance is worth more than this.
  double errorByChance() const;
};

/// The counts and times of a run; the figures that have nothing to divide by are NaN.
struct TargetMetrics {
  int frames = 0;          ///< All frames.
  int frames_in_view = 0;  ///< Frames with the target in view; the shares are of these.
  int right = 0;           ///< Of `frames_in_view`: the estimate is of the target.
  int wrong_person = 0;    ///< of another person,
  int nobody = 0;          ///< of nobody,
  int none = 0;            ///< or there is none. The four add up to `frames_in_view`.
  /// Of `right`: the estimate is nearer to somebody else than to the target.
  int contested = 0;
  int absent_wrong_person = 0;  ///< Target not in view, yet an estimate on another person.
  int absent_nobody = 0;        ///< Target not in view, yet an estimate on nobody.
  double error_sum_m = 0.0;     ///< Distance to the target over the `right` frames.

  Reliability reliability;  ///< Of the likeliest places, whether the target is there or not.

  double duration_s = 0.0;  ///< Last stamp minus first.
  /// Time on a wrong person, in view or not; a frame lasts until the next one.
  double wrong_target_s = 0.0;

  /// Delays from when the target could be had again (it came back into view, or its estimate went
  /// off it) to the next right frame, in order. The first time is an acquisition, not counted.
  std::vector<double> reacquisition_delays_s;
  int not_reacquired = 0;  ///< The target left, or the recording ended, before that.

  /// Adds another run's counts, times and delays: each frame counts the same.
  void add(const TargetMetrics& other);

  double recall() const;
  double wrongPersonShare() const;
  /// Of the frames without the target, those with an estimate.
  double claimedShare() const;
  /// Of all frames: an estimate of the target where it is in view, none where it is not.
  double rightAnswerShare() const;
  double meanError_m() const;
  double meanReacquisitionDelay_s() const;
  double longestReacquisitionDelay_s() const;
};

/// Judges a run. Frames must be in order of time.
/// @throws std::invalid_argument  if the distance is not positive or stamps do not increase.
TargetMetrics targetMetrics(const std::vector<TargetFrame>& frames, double match_distance_m = 0.5);

}  // namespace heel
