// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/target.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

constexpr double kKeep = 0.5;     // Of take_above: else the target would flicker about it.
constexpr double kBody_m = 0.35;  // The middles of two people are further apart.

void require(bool holds, const char* what) {
  if (!holds) {
    throw std::invalid_argument(std::string("TargetParams: ") + what);
  }
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
      return "recognized";
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
      return "nobody in view is likely to be the target";
    case TargetReason::kSeveralLookLike:
      return "several people may be the target";
    case TargetReason::kNotSureYet:
      return "somebody may be the target, not surely enough";
    case TargetReason::kTimeJumped:
      return "gap in time";
    case TargetReason::kFrameSkipped:
      return "frame skipped: its stamp was not later";
  }
  return "unknown";
}

TargetTracker::TargetTracker(const TargetParams& params, const TrackerParams& tracker_params,
                             GeometricGate gate, TargetLooks looks, TargetDensity density)
    : params_(params),
      tracker_(tracker_params, std::move(gate)),
      identity_(std::move(looks), params.identity, std::move(density)) {
  require(std::isfinite(params.start_distance_m) && params.start_distance_m >= 0.0,
          "start_distance_m must not be negative");
  require(params.take_above > 0.0 && params.take_above < 1.0, "take_above must be in (0, 1)");
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
  identity_.look(observations);
  const TrackerReport& report = tracker_.step(
      stamp_s, observations, viewpoint,
      [this](int track_id, int seen) { return identity_.logLikelihood(track_id, seen); });
  if (report.status == StepStatus::kSkipped) {
    estimate_.reason = TargetReason::kFrameSkipped;
    return estimate_;
  }
  identity_.step(stamp_s, tracker_.tracks(), report, observations, viewpoint);
  const bool had_place = estimate_.hasPlace();
  estimate_.verdict = GateVerdict::kAccepted;
  estimate_.reason = TargetReason::kSeen;
  estimate_.candidates = 0;
  if (report.dt_s < 0.0) {
    estimate_.last_seen.reset();  // Of another clock: nobody knows how long ago that was.
  }
  if (start_m_) {
    chooseAtStart();
  } else {
    choose();
  }
  estimate_.away = identity_.away();
  if (const Track* target = tracker_.findTrack(estimate_.track_id)) {
    describe(*target, observations);
  } else {
    explainNone();
    if (had_place && report.status == StepStatus::kGap)
      estimate_.reason = TargetReason::kTimeJumped;
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
  identity_.makeTarget(id, *start_m_, *tracker_.stamp_s());
  estimate_.track_id = id;
  estimate_.reason = TargetReason::kStarted;
  estimate_.last_seen = LastSeen{*tracker_.stamp_s(), *start_m_, Eigen::Vector2d::Zero()};
  had_target_ = true;
  start_m_.reset();
}

const Track* TargetTracker::likeliest() const {
  const Track* best = nullptr;
  double most = 0.0;
  for (const Track& track : tracker_.tracks()) {
    const double probability = identity_.targetProbability(track.id);
    if (probability > most) {
      most = probability;
      best = &track;
    }
  }
  return best;
}

double TargetTracker::probabilityAt(const Eigen::Vector2d& place_m, int but) const {
  double sum = 0.0;
  for (const Track& track : tracker_.tracks()) {
    if (track.id == but || (track.motion.position_m() - place_m).norm() > kBody_m) continue;
    sum += identity_.targetProbability(track.id);
  }
  return std::min(sum, 1.0);
}

/// The likeliest track, if the target is likely enough to be there.
void TargetTracker::choose() {
  const int former = std::exchange(estimate_.track_id, TargetEstimate::kNoTrack);
  if (!had_target_ && !params_.start_by_appearance) return;
  const Track* best = likeliest();
  if (best == nullptr) return;
  const bool is_former = best->id == former;
  const double least = (is_former ? kKeep : 1.0) * params_.take_above;
  if (probabilityAt(best->motion.position_m()) < least) return;
  tracker_.confirmTrack(best->id);
  estimate_.track_id = best->id;
  if (!is_former) estimate_.reason = TargetReason::kRecognized;
  had_target_ = true;
}

/// Says why nobody is the target.
void TargetTracker::explainNone() {
  estimate_.motion = {};
  estimate_.confidence = 0.0;
  bool somebody_in_view = false;
  for (const Track& track : tracker_.tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    somebody_in_view = true;
    const double probability = identity_.targetProbability(track.id);
    estimate_.candidates += probability > 0.1 ? 1 : 0;
    estimate_.confidence = std::max(estimate_.confidence, probability);
  }
  estimate_.status = had_target_ ? TargetStatus::kLost : TargetStatus::kNone;
  if (!had_target_ && !params_.start_by_appearance) {
    estimate_.reason = TargetReason::kNotStarted;
  } else if (!somebody_in_view) {
    estimate_.reason = TargetReason::kNobodyInView;
  } else if (estimate_.candidates > 1 && 1.0 - estimate_.away > params_.take_above) {
    estimate_.status = TargetStatus::kAmbiguous;
    estimate_.reason = TargetReason::kSeveralLookLike;
  } else {
    estimate_.reason =
        estimate_.candidates > 0 ? TargetReason::kNotSureYet : TargetReason::kNobodyLooksLike;
  }
}

/// Fills the estimate from the target's track.
void TargetTracker::describe(const Track& track, const std::vector<Observation>& observations) {
  estimate_.motion = track.motion;
  estimate_.confidence = probabilityAt(track.motion.position_m());
  if (track.status == TrackStatus::kConfirmed) {
    estimate_.status = TargetStatus::kFollowed;
    estimate_.last_seen =
        LastSeen{*tracker_.stamp_s(), track.motion.position_m(), track.motion.velocity_mps()};
  } else {
    estimate_.status = TargetStatus::kCoasting;
    if (estimate_.reason != TargetReason::kStarted) explainUnseen(track, observations);
  }
}

/// Finds what became of the observation nearest to where the target must be.
void TargetTracker::explainUnseen(const Track& track,
                                  const std::vector<Observation>& observations) {
  estimate_.reason = TargetReason::kNotObserved;
  double nearest_m = params_.start_distance_m;
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

}  // namespace heel
