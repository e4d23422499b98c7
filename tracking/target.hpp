// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The one person to follow, among everyone in view.
#pragma once

#include "tracking/tracker.hpp"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

namespace heel {

struct TargetParams {
  double start_distance_m = 0.5;  ///< A track this near to the place given at the start is it.
  /// Somebody is taken for the target by looks only if they have a confirmed track (which takes
  /// several frames) whose running mean of appearance is over this (more: stricter),
  double min_appearance = 0.41;
  /// and over this many times that of anyone else who could be the target,
  double min_appearance_ratio = 1.16;
  /// and if both held in this many frames in a row. Waiting longer was worse on real recordings:
  /// meanwhile people walk into the shade, and others come into view.
  int appearance_frames = 1;
  /// Somebody who is vouched for (see vouchFor()), and looks less like the target than that but not
  /// unlike it, is taken for it after so many frames in a row: the light is another there.
  int patient_frames = 12;
  /// Whoever was taken by looks but then looked less than min_appearance like the target on the
  /// whole was a doubtful find: each in a row doubles appearance_frames, up to so many times.
  int most_doubt = 1;
  /// After a loss nobody is taken who can't have walked there: further from the place where the
  /// target was last seen than max_speed_mps * (time since) + reach_slack_m.
  double max_speed_mps = 2.0;
  double reach_slack_m = 0.8;  ///< See max_speed_mps.
  /// Who is within expected_within_m of the place where the lost target is expected needs only
  /// release_share of min_appearance, and is taken before anyone else.
  double expected_within_m = 0.5;
  /// Whoever was taken by looks is let go once their appearance has been under this share of
  /// min_appearance
  double release_share = 0.6;
  /// for so long: they were somebody else, taken on one good look. A target that was started at a
  /// place is kept, for its looks were not what it was chosen by.
  double release_s = 2.0;
  bool release_started = false;  ///< Lets go of a target that was started at a place, too.
  /// Somebody in view who for takeover_s looks so many times more like the target than whoever is
  /// followed is the target; infinite: never. For an appearance that tells people well apart.
  double takeover_ratio = std::numeric_limits<double>::infinity();
  double takeover_s = 0.5;  ///< See takeover_ratio.
  /// Over it nobody is out of reach: where the target was seen last was a mistake.
  double sure_appearance = 1.0;
  double excluded_within_m = 0.3;     ///< Who is so near to a place given to exclude() is excluded,
  double vouched_within_m = 0.4;      ///< and to one given to vouchFor() is a person.
  double coast_memory_s = 1.0;        ///< Time unseen in which the confidence falls to 1/e.
  double confusion_distance_m = 0.8;  ///< Somebody nearer than this can be mistaken for the target.
  bool start_by_appearance = true;    ///< Find the target by looks when no start was given.

  /// With less than this somebody looks otherwise than the target.
  double leastAppearance() const { return release_share * min_appearance; }
};

enum class TargetStatus {
  kNone,       ///< There was no target yet.
  kFollowed,   ///< The target's track was seen in this frame.
  kCoasting,   ///< It was not; its place is predicted.
  kAmbiguous,  ///< No target: several people look like it, and nothing tells them apart.
  kLost,       ///< No target: its track ended, and it was not found again yet.
};
inline constexpr int kTargetStatuses = 5;
const char* toText(TargetStatus status);

/// Why the status is what it is; for a target that is not seen, what became of its observation.
enum class TargetReason {
  kNotStarted,       ///< Waits for a start.
  kSeen,             ///< Seen where it was expected.
  kStarted,          ///< Started at the place given.
  kRecognized,       ///< Found by its looks.
  kNotObserved,      ///< Nothing was observed near its place.
  kRejectedByGate,   ///< What was observed near its place can't be seen there; see `verdict`.
  kTakenByOther,     ///< What was observed near its place belongs to other people's tracks.
  kOutsideGate,      ///< What was observed near its place is unlikely to be it.
  kNobodyInView,     ///< Nobody has a confirmed track.
  kNobodyLooksLike,  ///< Nobody in view looks enough like it.
  kOutOfReach,       ///< Who looks like it can't have walked there since it was last seen.
  kSeveralLookLike,  ///< Several in view look like it.
  kNotSureYet,       ///< Somebody looks like it, but not for enough frames.
  kTimeJumped,       ///< A gap in time ended its track.
  kFrameSkipped,     ///< The frame's stamp was not later; all is as before.
};
inline constexpr int kTargetReasons = 15;
const char* toText(TargetReason reason);

/// Where and when the target was last seen: where to go and which way to turn when it is lost.
struct LastSeen {
  double stamp_s = 0.0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
};

/// Where the target is, or why there is none.
struct TargetEstimate {
  static constexpr int kNoTrack = 0;

  TargetStatus status = TargetStatus::kNone;
  TargetReason reason = TargetReason::kNotStarted;
  /// Of an observation near the target's place, where the reason is kRejectedByGate.
  GateVerdict verdict = GateVerdict::kAccepted;
  int track_id = kNoTrack;  ///< Of the target, while it is followed or coasting.
  MotionState motion;       ///< Where it is, while it is followed or coasting.
  double appearance = 0.0;  ///< Of its track.
  /// In [0, 1], 0 without a target: the product of its appearance, e^(-time unseen / memory), and
  /// its share of the appearance of all who are near enough to be mistaken for it.
  double confidence = 0.0;
  int candidates = 0;  ///< Without a target: people in view who look like it and can be it.
  std::optional<LastSeen> last_seen;  ///< Absent too after the clock was set back.

  bool hasPlace() const {
    return status == TargetStatus::kFollowed || status == TargetStatus::kCoasting;
  }
};

/// Tracks everyone in view and knows which one, if any, is the target.
///
/// The target is one track for as long as that track lives: nobody's looks can take it over. Other
/// people's tracks explain their own observations, whatever they look like. When the target's track
/// has ended, the one who looks like the target, clearly more so than anybody else, becomes it
/// again; of two who look alike neither does.
class TargetTracker {
 public:
  /// @throws std::invalid_argument  if a parameter is out of range; the text names it.
  explicit TargetTracker(const TargetParams& params = {}, const TrackerParams& tracker_params = {},
                         GeometricGate gate = {});

  /// Says where the target is at the next step's stamp (after phase 1: the first person's place).
  /// The nearest track becomes the target; if none is near, one is started there.
  /// @throws std::invalid_argument  if the place is not finite.
  void startAt(const Eigen::Vector2d& position_m);

  /// Says where another sensor has the target, for the next steps; nothing where none has. That
  /// counts as seen there: nobody is the target who can't have walked to where they are from it.
  void expectAt(const std::optional<Eigen::Vector2d>& position_m) { expected_m_ = position_m; }

  /// Says where others are known to be, for the next steps: nobody there is taken for the target.
  void exclude(const std::vector<Eigen::Vector2d>& places_m) { excluded_m_ = places_m; }

  /// Says where another sensor is sure of people, for the next steps: they are no furniture, and
  /// may be the target with less likeness to it.
  void vouchFor(const std::vector<Eigen::Vector2d>& places_m) { vouched_m_ = places_m; }

  /// Takes in the observations made at `stamp_s`.
  /// @return The target, valid until the next call.
  /// @throws std::invalid_argument  if the stamp is not finite.
  const TargetEstimate& step(double stamp_s, const std::vector<Observation>& observations,
                             const Viewpoint& viewpoint = {});

  const TargetEstimate& estimate() const { return estimate_; }
  const Tracker& tracker() const { return tracker_; }
  const TargetParams& params() const { return params_; }

 private:
  void chooseAtStart();
  bool search();
  void take(const Track& track, TargetReason reason);
  bool isMistaken(const Track& track);
  void judgeFind();
  void describe(const Track& track, const std::vector<Observation>& observations);
  void explainUnseen(const Track& track, const std::vector<Observation>& observations);
  double confidenceOf(const Track& track) const;
  bool canBeTarget(const Track& track) const;
  bool isExpected(const Track& track) const;
  bool isExcluded(const Track& track) const;
  bool looksLikeTarget(const Track& track) const;
  const Track* findBetter(const Track& target);

  TargetParams params_;
  Tracker tracker_;
  TargetEstimate estimate_;
  std::optional<Eigen::Vector2d> start_m_;
  std::optional<Eigen::Vector2d> expected_m_;
  std::vector<Eigen::Vector2d> excluded_m_;
  std::vector<Eigen::Vector2d> vouched_m_;
  bool had_target_ = false;
  bool taken_by_looks_ = false;
  std::optional<double>
      unlike_since_s_;                   // The target has looked unlike itself in all frames since.
  std::optional<LastSeen> seen_before_;  // What was known when the target was taken by looks.
  double looks_ = 0.0;                   // Sum of the target's appearance since it was taken
  int looked_ = 0;                       // in so many frames.
  int doubt_ = 1;                        // See most_doubt.
  int likely_id_ = TargetEstimate::kNoTrack;  ///< Who alone looked like the target last frame,
  int likely_frames_ = 0;                     ///< and in how many frames in a row.
  int better_id_ = TargetEstimate::kNoTrack;  ///< Who looks more like the target than the target,
  double better_since_s_ = 0.0;               ///< and since when.
};

}  // namespace heel
