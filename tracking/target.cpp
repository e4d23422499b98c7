// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/target.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

void require(bool holds, const char* what) {
  if (!holds) {
    throw std::invalid_argument(std::string("TargetParams: ") + what);
  }
}

bool isNotNegative(double value) { return std::isfinite(value) && value >= 0.0; }

bool isNearAny(const Track& track, const std::vector<Eigen::Vector2d>& places_m, double within_m) {
  return std::any_of(places_m.begin(), places_m.end(), [&](const Eigen::Vector2d& place_m) {
    return (track.motion.position_m() - place_m).norm() < within_m;
  });
}

}  // namespace

const char* toText(TargetStatus status) {
  switch (status) {
    case TargetStatus::kNone:
      return "none yet";
    case TargetStatus::kFollowed:
      return "followed";
    case TargetStatus::kCoasting:
      return "coasting";
    case TargetStatus::kAmbiguous:
      return "ambiguous";
    case TargetStatus::kLost:
      return "lost";
  }
  return "unknown";
}

const char* toText(TargetReason reason) {
  switch (reason) {
    case TargetReason::kNotStarted:
      return "waits for a start";
    case TargetReason::kSeen:
      return "seen";
    case TargetReason::kStarted:
      return "started at the given place";
    case TargetReason::kRecognized:
      return "recognized by its looks";
    case TargetReason::kNotObserved:
      return "nothing observed near its place";
    case TargetReason::kRejectedByGate:
      return "the observation near its place was rejected by the geometric gate";
    case TargetReason::kTakenByOther:
      return "the observation near its place is another person's";
    case TargetReason::kOutsideGate:
      return "the observation near its place is unlikely to be the target";
    case TargetReason::kNobodyInView:
      return "nobody in view";
    case TargetReason::kNobodyLooksLike:
      return "nobody in view looks like the target";
    case TargetReason::kOutOfReach:
      return "who looks like the target cannot have walked there";
    case TargetReason::kSeveralLookLike:
      return "several people look like the target";
    case TargetReason::kNotSureYet:
      return "somebody looks like the target, not for long enough yet";
    case TargetReason::kTimeJumped:
      return "gap in time";
    case TargetReason::kFrameSkipped:
      return "frame skipped: its stamp was not later";
  }
  return "unknown";
}

TargetTracker::TargetTracker(const TargetParams& params, const TrackerParams& tracker_params,
                             GeometricGate gate)
    : params_(params), tracker_(tracker_params, std::move(gate)) {
  require(isNotNegative(params.start_distance_m), "start_distance_m must not be negative");
  require(params.min_appearance >= 0.0 && params.min_appearance <= 1.0,
          "min_appearance must be in [0, 1]");
  require(std::isfinite(params.min_appearance_ratio) && params.min_appearance_ratio >= 1.0,
          "min_appearance_ratio must be at least 1");
  require(params.appearance_frames >= 1, "appearance_frames must be at least 1");
  require(params.patient_frames >= 1, "patient_frames must be at least 1");
  require(params.most_doubt >= 1, "most_doubt must be at least 1");
  require(isNotNegative(params.expected_within_m), "expected_within_m must not be negative");
  require(params.release_share >= 0.0 && params.release_share <= 1.0,
          "release_share must be in [0, 1]");
  require(params.release_s >= 0.0, "release_s must not be negative");
  require(params.takeover_ratio >= 1.0, "takeover_ratio must be at least 1");
  require(isNotNegative(params.takeover_s), "takeover_s must not be negative");
  require(isNotNegative(params.excluded_within_m), "excluded_within_m must not be negative");
  require(isNotNegative(params.vouched_within_m), "vouched_within_m must not be negative");
  require(params.max_speed_mps > 0.0, "max_speed_mps must be positive");
  require(isNotNegative(params.reach_slack_m), "reach_slack_m must not be negative");
  require(params.coast_memory_s > 0.0, "coast_memory_s must be positive");
  require(isNotNegative(params.confusion_distance_m), "confusion_distance_m must not be negative");
}

void TargetTracker::startAt(const Eigen::Vector2d& position_m) {
  if (!position_m.allFinite()) {
    throw std::invalid_argument("TargetTracker: the start is not finite");
  }
  start_m_ = position_m;
}

const TargetEstimate& TargetTracker::step(double stamp_s,
                                          const std::vector<Observation>& observations,
                                          const Viewpoint& viewpoint) {
  const TrackerReport& report = tracker_.step(stamp_s, observations, viewpoint);
  if (report.status == StepStatus::kSkipped) {
    estimate_.reason = TargetReason::kFrameSkipped;
    return estimate_;
  }
  const bool had_target = estimate_.hasPlace();
  estimate_.verdict = GateVerdict::kAccepted;
  estimate_.reason = TargetReason::kSeen;
  estimate_.candidates = 0;
  if (report.status == StepStatus::kGap && report.dt_s < 0.0) {
    estimate_.last_seen.reset();  // Of another clock: nobody knows how long ago that was.
  }
  if (start_m_) {
    chooseAtStart();
  }
  const Track* target = tracker_.findTrack(estimate_.track_id);
  if (target != nullptr && isMistaken(*target)) {
    estimate_.track_id = TargetEstimate::kNoTrack;
    estimate_.last_seen = seen_before_;
    target = nullptr;
  }
  if (target != nullptr) {
    if (const Track* better = findBetter(*target)) {
      take(*better, TargetReason::kRecognized);
      target = better;
    }
  }
  if (had_target && target == nullptr) judgeFind();
  if (target == nullptr && had_target_ && expected_m_) {
    estimate_.last_seen = LastSeen{stamp_s, *expected_m_, Eigen::Vector2d::Zero()};
  }
  if (target == nullptr && search()) {
    target = tracker_.findTrack(estimate_.track_id);
  }
  if (target != nullptr) {
    describe(*target, observations);
  } else {
    estimate_.track_id = TargetEstimate::kNoTrack;
    estimate_.motion = {};
    estimate_.appearance = estimate_.confidence = 0.0;
    if (had_target && report.status == StepStatus::kGap &&
        estimate_.reason != TargetReason::kSeveralLookLike) {
      estimate_.reason = TargetReason::kTimeJumped;
    }
  }
  return estimate_;
}

/// The track nearest to the start becomes the target, or a new one there.
void TargetTracker::chooseAtStart() {
  const Track* nearest = nullptr;
  double nearest_m = params_.start_distance_m;
  for (const Track& track : tracker_.tracks()) {
    const double distance_m = (track.motion.position_m() - *start_m_).norm();
    if (distance_m <= nearest_m && (nearest == nullptr || distance_m < nearest_m)) {
      nearest = &track;
      nearest_m = distance_m;
    }
  }
  const int id = nearest != nullptr ? nearest->id : tracker_.addTrack(*start_m_);
  tracker_.confirmTrack(id);
  take(*tracker_.findTrack(id), TargetReason::kStarted);
  estimate_.last_seen = LastSeen{*tracker_.stamp_s(), *start_m_, Eigen::Vector2d::Zero()};
  start_m_.reset();
}

/// Looks for the target among everyone in view, by appearance; false, and why, if there is none.
bool TargetTracker::search() {
  const Track *best = nullptr, *second = nullptr;
  bool somebody_in_view = false, out_of_reach = false;
  for (const Track& track : tracker_.tracks()) {
    if (track.status != TrackStatus::kConfirmed || isExcluded(track)) {
      continue;
    }
    if (isExpected(track)) {
      take(track, TargetReason::kRecognized);
      return true;
    }
    somebody_in_view = true;
    const bool looks_like = looksLikeTarget(track);
    if (!canBeTarget(track)) {
      out_of_reach = out_of_reach || looks_like;
      continue;
    }
    estimate_.candidates += looks_like ? 1 : 0;
    if (best == nullptr || track.log_appearance > best->log_appearance) {
      second = std::exchange(best, &track);
    } else if (second == nullptr || track.log_appearance > second->log_appearance) {
      second = &track;
    }
  }

  estimate_.status = had_target_ ? TargetStatus::kLost : TargetStatus::kNone;
  const int was_likely = std::exchange(likely_id_, TargetEstimate::kNoTrack);
  if (!had_target_ && !params_.start_by_appearance) {
    estimate_.reason = TargetReason::kNotStarted;
  } else if (estimate_.candidates == 0 || !looksLikeTarget(*best)) {
    estimate_.reason = !somebody_in_view ? TargetReason::kNobodyInView
                       : out_of_reach    ? TargetReason::kOutOfReach
                                         : TargetReason::kNobodyLooksLike;
  } else if (second != nullptr &&
             best->appearance() <= params_.min_appearance_ratio * second->appearance()) {
    estimate_.status = TargetStatus::kAmbiguous;
    estimate_.reason = TargetReason::kSeveralLookLike;
  } else {
    likely_id_ = best->id;
    likely_frames_ = was_likely == best->id ? likely_frames_ + 1 : 1;
    const bool is_clear = best->appearance() > params_.min_appearance;
    const int enough = is_clear ? doubt_ * params_.appearance_frames : params_.patient_frames;
    if (likely_frames_ >= enough) {
      take(*best, TargetReason::kRecognized);
      return true;
    }
    estimate_.reason = TargetReason::kNotSureYet;
  }
  return false;
}

void TargetTracker::take(const Track& track, TargetReason reason) {
  estimate_.track_id = track.id;
  estimate_.reason = reason;
  likely_id_ = better_id_ = TargetEstimate::kNoTrack;
  had_target_ = true;
  taken_by_looks_ = reason == TargetReason::kRecognized;
  unlike_since_s_.reset();
  seen_before_ = estimate_.last_seen;
  looks_ = 0.0;
  looked_ = 0;
}

/// Whoever is like the target for a moment only will be so again.
void TargetTracker::judgeFind() {
  if (!taken_by_looks_ || looked_ == 0) return;
  const bool is_doubtful = looks_ < params_.min_appearance * looked_;
  doubt_ = is_doubtful ? std::min(2 * doubt_, params_.most_doubt) : 1;
}

/// Whether the target was taken by looks that it has not had for some time.
bool TargetTracker::isMistaken(const Track& track) {
  if (track.status != TrackStatus::kConfirmed) return false;  // Unseen: its looks are old.
  const bool may_be_mistaken = taken_by_looks_ || params_.release_started;
  if (!may_be_mistaken || track.appearance() >= params_.leastAppearance()) {
    unlike_since_s_.reset();
    return false;
  }
  if (!unlike_since_s_) unlike_since_s_ = *tracker_.stamp_s();
  return *tracker_.stamp_s() - *unlike_since_s_ >= params_.release_s;
}

/// Who has looked so much more like the target for so long that they must be it; null if nobody.
const Track* TargetTracker::findBetter(const Track& target) {
  if (std::isinf(params_.takeover_ratio)) return nullptr;
  const Track* best = nullptr;
  const double least =
      std::max(params_.min_appearance, params_.takeover_ratio * target.appearance());
  for (const Track& track : tracker_.tracks()) {
    if (track.id == target.id || track.status != TrackStatus::kConfirmed || isExcluded(track) ||
        track.appearance() <= least) {
      continue;
    }
    if (best == nullptr || track.log_appearance > best->log_appearance) best = &track;
  }
  const int id = best != nullptr ? best->id : TargetEstimate::kNoTrack;
  if (std::exchange(better_id_, id) != id) better_since_s_ = *tracker_.stamp_s();
  return *tracker_.stamp_s() - better_since_s_ >= params_.takeover_s ? best : nullptr;
}

/// Fills the estimate from the target's track.
void TargetTracker::describe(const Track& track, const std::vector<Observation>& observations) {
  estimate_.motion = track.motion;
  estimate_.appearance = track.appearance();
  estimate_.confidence = confidenceOf(track);
  if (track.status == TrackStatus::kConfirmed) {
    estimate_.status = TargetStatus::kFollowed;
    looks_ += track.appearance();
    ++looked_;
    estimate_.last_seen =
        LastSeen{*tracker_.stamp_s(), track.motion.position_m(), track.motion.velocity_mps()};
  } else {
    estimate_.status = TargetStatus::kCoasting;
    if (estimate_.reason != TargetReason::kStarted) {
      explainUnseen(track, observations);
    }
  }
}

/// Finds what became of the observation nearest to where the target must be.
void TargetTracker::explainUnseen(const Track& track,
                                  const std::vector<Observation>& observations) {
  estimate_.reason = TargetReason::kNotObserved;
  double nearest_m = tracker_.params().max_residual_m;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const double distance_m = (observations[i].position_m - track.motion.position_m()).norm();
    if (!(distance_m < nearest_m)) {  // False for a place that is no number, too.
      continue;
    }
    nearest_m = distance_m;
    const ObservationUse& use = tracker_.report().uses[i];
    estimate_.verdict = use.verdict;
    switch (use.fate) {
      case ObservationFate::kRejected:
        estimate_.reason = TargetReason::kRejectedByGate;
        break;
      case ObservationFate::kUpdated:
      case ObservationFate::kFragment:
        estimate_.reason = TargetReason::kTakenByOther;
        break;
      case ObservationFate::kTooLittle:
      case ObservationFate::kBorn:
      case ObservationFate::kIgnored:
        estimate_.reason = TargetReason::kOutsideGate;
        break;
    }
  }
}

double TargetTracker::confidenceOf(const Track& track) const {
  double all = 0.0;
  for (const Track& other : tracker_.tracks()) {
    const double distance_m = (other.motion.position_m() - track.motion.position_m()).norm();
    const bool can_be_mistaken =
        other.status != TrackStatus::kTentative && distance_m < params_.confusion_distance_m;
    all += other.id == track.id || can_be_mistaken ? other.appearance() : 0.0;
  }
  const double unseen_s = *tracker_.stamp_s() - track.seen_s;
  return track.appearance() * std::exp(-unseen_s / params_.coast_memory_s) *
         (track.appearance() / all);
}

/// Whether this is the lost target where another sensor has it, looking not too unlike itself.
bool TargetTracker::isExpected(const Track& track) const {
  return had_target_ && expected_m_ &&
         (track.motion.position_m() - *expected_m_).norm() < params_.expected_within_m &&
         track.appearance() > params_.leastAppearance();
}

/// Whether somebody else is known to be where this track is.
bool TargetTracker::isExcluded(const Track& track) const {
  return isNearAny(track, excluded_m_, params_.excluded_within_m);
}

/// Of a person less is asked than of what may be furniture.
bool TargetTracker::looksLikeTarget(const Track& track) const {
  const bool is_person = isNearAny(track, vouched_m_, params_.vouched_within_m);
  return track.appearance() > (is_person ? params_.leastAppearance() : params_.min_appearance);
}

/// Whether the target can have walked to where this track is.
bool TargetTracker::canBeTarget(const Track& track) const {
  if (!estimate_.last_seen || track.appearance() > params_.sure_appearance) {
    return true;
  }
  const double away_m = (track.motion.position_m() - estimate_.last_seen->position_m).norm();
  const double time_s = *tracker_.stamp_s() - estimate_.last_seen->stamp_s;
  return away_m <= params_.max_speed_mps * time_s + params_.reach_slack_m;
}

}  // namespace heel
