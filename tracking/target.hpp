// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The one person to follow, among everyone in view.
#pragma once

#include <heel/tracking/identity.hpp>
#include <heel/tracking/tracker.hpp>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace heel {

/// When somebody is the target, and no longer.
struct TargetParams {
  IdentityParams identity;
  double start_distance_m = 0.5;  ///< A track this near to a given starting place is the target.
  /// Somebody is taken for the target from this probability on. If a wrong person costs c times as
  /// much as a lost one, it is c / (1 + c). Who was taken stays the target down to half of it.
  double take_above = 0.8;
  /// Whether the target is found by looks when no starting place was given.
  bool start_by_appearance = true;
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
  kRecognized,       ///< Found by its looks, its way and its place.
  kNotObserved,      ///< Nothing was observed near its place.
  kRejectedByGate,   ///< What was observed near its place can't be seen there; see `verdict`.
  kTakenByOther,     ///< What was observed near its place belongs to other people's tracks.
  kOutsideGate,      ///< What was observed near its place is unlikely to be it.
  kNobodyInView,     ///< Nobody has a confirmed track.
  kNobodyLooksLike,  ///< Nobody in view is likely to be it.
  kSeveralLookLike,  ///< Surely one of several in view is it, but which?
  kNotSureYet,       ///< Somebody may be it, but as likely is not.
  kTimeJumped,       ///< A gap in time ended its track.
  kFrameSkipped,     ///< The frame's stamp was not later; all is as before.
};
inline constexpr int kTargetReasons = 14;
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
  /// Probability that the target is there; without one, that the likeliest track is it.
  double confidence = 0.0;
  double away = 1.0;                  ///< Probability that the target is nobody in view.
  int candidates = 0;                 ///< Without a target: people in view who may be it.
  std::optional<LastSeen> last_seen;  ///< Absent too after the clock was set back.

  bool hasPlace() const {
    return status == TargetStatus::kFollowed || status == TargetStatus::kCoasting;
  }
};

/// Tracks everyone in view and believes, of each, who it is; the target is whoever is it with
/// enough probability. See Identity.
class TargetTracker {
 public:
  /// @throws std::invalid_argument  if a parameter is out of range; the text names it.
  /// @param looks  What the target looks like; by default nothing is known of it.
  explicit TargetTracker(const TargetParams& params = {}, const TrackerParams& tracker_params = {},
                         GeometricGate gate = {}, TargetLooks looks = {},
                         TargetDensity density = {});

  /// Says where the target is at the next step's stamp (after phase 1: the first person's place).
  /// The nearest track becomes the target; if none is near, one is started there.
  /// @throws std::invalid_argument  if the place is not finite.
  void startAt(const Eigen::Vector2d& position_m);

  /// Takes in the observations made at `stamp_s`.
  /// @return The target, valid until the next call.
  /// @throws std::invalid_argument  if the stamp is not finite.
  const TargetEstimate& step(double stamp_s, const std::vector<Observation>& observations,
                             const Viewpoint& viewpoint = {});

  const TargetEstimate& estimate() const { return estimate_; }
  const Tracker& tracker() const { return tracker_; }
  /// The track that is likeliest to be the target; null: none may be.
  const Track* likeliest() const;
  /// That the target is at a place: that it is a track there, of which several may be one body's.
  /// @param but  A track that does not count.
  double probabilityAt(const Eigen::Vector2d& place_m, int but = TargetEstimate::kNoTrack) const;
  const Identity& identity() const { return identity_; }
  const TargetParams& params() const { return params_; }

 private:
  void chooseAtStart();
  void choose();
  void explainNone();
  void describe(const Track& track, const std::vector<Observation>& observations);
  void explainUnseen(const Track& track, const std::vector<Observation>& observations);

  TargetParams params_;
  Tracker tracker_;
  Identity identity_;
  TargetEstimate estimate_;
  std::optional<Eigen::Vector2d> start_m_;
  bool had_target_ = false;
};

}  // namespace heel
