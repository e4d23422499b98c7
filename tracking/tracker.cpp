// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/tracker.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace heel {
namespace {

constexpr double kStampTolerance_s = 1e-6;  // Sums of decimal stamps are not exact.
constexpr double kLeastScoreShare = 1e-3;   // A score of 0 counts as this share of the best.
constexpr double kUnlikely = 14.0;          // -2 ln of a likelihood ratio of 1 to 1000.

std::size_t at(int index) { return static_cast<std::size_t>(index); }

int countSeen(std::uint32_t history, int frames) {
  int seen = 0;
  for (int k = 0; k < frames; ++k) {
    seen += static_cast<int>((history >> k) & 1U);
  }
  return seen;
}

}  // namespace

Tracker::Tracker(const TrackerParams& params, GeometricGate gate)
    : params_(params), gate_(std::move(gate)) {
  checkParams(params_);
  noise_m2_ = Eigen::Matrix2d::Identity() * (params_.position_sigma_m * params_.position_sigma_m);
  gate_limit_ = chiSquare2Quantile(params_.gate_prob);
  // With this constant a pair costs more than 0 (the cost of leaving it) exactly where "unseen, and
  // somebody new there" is likelier than "seen there".
  base_cost_ = 2.0 * std::log(params_.new_density_per_m2 * (1.0 - params_.detection_prob) /
                              params_.detection_prob);
}

const TrackerReport& Tracker::step(double stamp_s, const std::vector<Observation>& observations,
                                   const Viewpoint& viewpoint, const LookLikelihood& looks) {
  if (!std::isfinite(stamp_s)) {
    throw std::invalid_argument("Tracker: the stamp is not finite");
  }
  report_.verdicts.fill(0);
  report_.updated = report_.born = 0;
  report_.uses.assign(observations.size(), {});
  report_.lost.clear();
  report_.swaps.clear();
  if (!advanceTo(stamp_s)) {
    return report_;
  }
  gateObservations(observations, viewpoint);
  for (Track& track : tracks_) {
    track.observation = Track::kUnseen;
  }
  fillCosts(observations, looks);
  column_of_track_.assign(tracks_.size(), Assignment::kNone);
  is_shared_.assign(tracks_.size(), false);
  associate(false);
  associate(true);
  noteSwaps();
  updateTracks(stamp_s, observations);
  endTracks(stamp_s);
  startTracks(stamp_s, observations);
  return report_;
}

/// Predicts all tracks to the stamp; false if the frame is to be skipped.
bool Tracker::advanceTo(double stamp_s) {
  report_.dt_s = stamp_s_ ? stamp_s - *stamp_s_ : 0.0;
  if (!stamp_s_) {
    report_.status = StepStatus::kFirst;
  } else if (std::abs(report_.dt_s) > params_.max_gap_s) {
    report_.status = StepStatus::kGap;
    for (const Track& track : tracks_) {
      if (track.status != TrackStatus::kTentative) {
        report_.lost.push_back(track.id);
      }
    }
    tracks_.clear();
  } else if (report_.dt_s <= 0.0) {
    report_.status = StepStatus::kSkipped;
    return false;
  } else {
    report_.status = StepStatus::kRegular;
    for (Track& track : tracks_) {
      track.motion = predict(track.motion, report_.dt_s, params_.motion);
    }
  }
  stamp_s_ = stamp_s;
  return true;
}

/// Lists what the gate accepts, ordered by value so that the input's order has no influence.
void Tracker::gateObservations(const std::vector<Observation>& observations,
                               const Viewpoint& viewpoint) {
  accepted_.clear();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    ObservationUse& use = report_.uses[i];
    if (!o.position_m.allFinite() || !std::isfinite(o.score) || !o.covariance_m2.allFinite()) {
      use.verdict = GateVerdict::kNotFinite;
    } else if (gate_) {
      use.verdict = gate_(o, viewpoint);
    }
    ++report_.verdicts[static_cast<std::size_t>(use.verdict)];
    if (use.verdict == GateVerdict::kAccepted) {
      accepted_.push_back(static_cast<int>(i));
    } else {
      use.fate = ObservationFate::kRejected;
    }
  }
  std::sort(accepted_.begin(), accepted_.end(), [&](int a, int b) {
    const auto key = [&](int i) {
      const Observation& o = observations[at(i)];
      return std::make_tuple(-o.score, o.position_m.x(), o.position_m.y());
    };
    return key(a) < key(b);
  });
}

/// A pair's cost is -2 ln of its likelihood over that of leaving both, which costs 0.
void Tracker::fillCosts(const std::vector<Observation>& observations, const LookLikelihood& looks) {
  costs_.reset(static_cast<int>(tracks_.size()), static_cast<int>(accepted_.size()));
  for (int row = 0; row < costs_.rows(); ++row) {
    const Track& track = tracks_[at(row)];
    const double reach_m = params_.slack_m + params_.max_speed_mps * (*stamp_s_ - track.seen_s);
    double best_score = 0.0;
    for (int column = 0; column < costs_.columns(); ++column) {
      const int index = accepted_[at(column)];
      const Observation& o = observations[at(index)];
      const Innovation seen = innovation(track.motion, o.position_m, noiseOf(o));
      const double distance2 = squaredMahalanobis(seen);
      if (distance2 > gate_limit_ || seen.residual_m.norm() > reach_m) continue;
      costs_(row, column) = base_cost_ + distance2 +
                            std::log(2.0 * M_PI * 2.0 * M_PI * seen.covariance_m2.determinant()) -
                            (looks ? 2.0 * looks(track.id, index) : 0.0);
      best_score = std::max(best_score, o.score);
    }
    for (int column = 0; column < costs_.columns() && best_score > 0.0; ++column) {
      const double share = observations[at(accepted_[at(column)])].score / best_score;
      costs_(row, column) -= params_.score_weight * std::log(std::max(share, kLeastScoreShare));
    }
  }
}

/// Gives the observations that are still free to the tentative tracks, or to all others.
void Tracker::associate(bool tentative) {
  rows_.clear();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if ((tracks_[i].status == TrackStatus::kTentative) == tentative) {
      rows_.push_back(static_cast<int>(i));
    }
  }
  free_.clear();
  for (int column = 0; column < costs_.columns(); ++column) {
    if (report_.uses[at(accepted_[at(column)])].fate != ObservationFate::kUpdated) {
      free_.push_back(column);
    }
  }
  choice_.reset(static_cast<int>(rows_.size()), static_cast<int>(free_.size()));
  for (int row = 0; row < choice_.rows(); ++row) {
    for (int column = 0; column < choice_.columns(); ++column) {
      choice_(row, column) = costs_(rows_[at(row)], free_[at(column)]);
    }
  }
  solver_.solve(choice_, 0.0, assignment_);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const int column = assignment_.column_of_row[row];
    if (column == Assignment::kNone) continue;
    Track& track = tracks_[at(rows_[row])];
    column_of_track_[at(rows_[row])] = free_[at(column)];
    track.observation = accepted_[at(free_[at(column)])];
    report_.uses[at(track.observation)] = {ObservationFate::kUpdated, GateVerdict::kAccepted,
                                           track.id};
    ++report_.updated;
  }
}

/// Notes which tracks, and which observations that nobody took, may as well be each other's.
void Tracker::noteSwaps() {
  const auto cost = [this](int row, int column) {
    return column == Assignment::kNone ? 0.0 : costs_(row, column);
  };
  const auto probabilityOf = [](double more) { return 1.0 / (1.0 + std::exp(0.5 * more)); };
  newcomers_.clear();
  for (int a = 0; a < costs_.rows(); ++a) {
    const Track& track = tracks_[at(a)];
    const int seen_a = column_of_track_[at(a)];
    for (int b = a + 1; b < costs_.rows(); ++b) {
      const Track& other = tracks_[at(b)];
      const int seen_b = column_of_track_[at(b)];
      if (seen_a == seen_b) continue;
      // Who is unseen where an observation is may have been observed as one with whom it is of.
      if (seen_b == Assignment::kNone && cost(b, seen_a) < 0.0) is_shared_[at(a)] = true;
      if (seen_a == Assignment::kNone && cost(a, seen_b) < 0.0) is_shared_[at(b)] = true;
      const double more = cost(a, seen_b) + cost(b, seen_a) - cost(a, seen_a) - cost(b, seen_b);
      if (more < kUnlikely) report_.swaps.push_back({track.id, other.id, probabilityOf(more)});
    }
    for (int column = 0; seen_a != Assignment::kNone && column < costs_.columns(); ++column) {
      const int index = accepted_[at(column)];
      const double more = cost(a, column) - cost(a, seen_a);
      if (report_.uses[at(index)].fate == ObservationFate::kUpdated || !(more < kUnlikely))
        continue;
      newcomers_.push_back({track.id, index, probabilityOf(more)});
    }
  }
}

void Tracker::updateTracks(double stamp_s, const std::vector<Observation>& observations) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    const bool seen = track.observation != Track::kUnseen;
    track.history = (track.history << 1) | (seen ? 1U : 0U);
    if (seen) {
      const Observation& o = observations[at(track.observation)];
      Eigen::Matrix2d noise_m2 = noiseOf(o);
      if (is_shared_[i]) {  // Then its place is somewhere between them.
        const double half_m = 0.5 * params_.birth_clearance_m;
        noise_m2 += Eigen::Matrix2d::Identity() * (half_m * half_m);
      }
      track.density_per_m2 =
          std::exp(heel::logLikelihood(innovation(track.motion, o.position_m, noise_m2)));
      track.motion = update(track.motion, o.position_m, noise_m2);
      ++track.hits;
      track.score = o.score;
      track.seen_s = stamp_s;
    }
    if (track.status != TrackStatus::kTentative ||
        countSeen(track.history, params_.confirm_frames) >= params_.confirm_hits) {
      track.status = seen ? TrackStatus::kConfirmed : TrackStatus::kCoasting;
    }
  }
}

void Tracker::endTracks(double stamp_s) {
  const auto ends = [&](const Track& track) {
    if (track.status == TrackStatus::kTentative) {
      // Its first frame's bit, a 1, has moved up by one place each frame.
      return (track.history >> (params_.confirm_frames - 1)) != 0;
    }
    return stamp_s - track.seen_s > params_.max_coast_s + kStampTolerance_s;
  };
  for (const Track& track : tracks_) {
    if (ends(track) && track.status != TrackStatus::kTentative) {
      report_.lost.push_back(track.id);
    }
  }
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), ends), tracks_.end());
}

Track& Tracker::startTrack(double stamp_s, const Eigen::Vector2d& position_m,
                           const Eigen::Matrix2d& noise_m2) {
  Track& track = tracks_.emplace_back();
  track.id = next_id_++;
  track.motion = startMotion(position_m, noise_m2, params_.start_speed_sigma_mps);
  track.seen_s = stamp_s;
  return track;
}

/// Starts a track on each observation that no track took and that is no fragment of one.
void Tracker::startTracks(double stamp_s, const std::vector<Observation>& observations) {
  for (const int index : accepted_) {  // By falling score, so that fragments come after their body.
    ObservationUse& use = report_.uses[at(index)];
    if (use.fate == ObservationFate::kUpdated) {
      continue;
    }
    const Observation& o = observations[at(index)];
    if (!o.can_start) {
      use.fate = ObservationFate::kTooLittle;
      continue;
    }
    const auto body = std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) {
      return track.observation != Track::kUnseen &&
             (observations[at(track.observation)].position_m - o.position_m).norm() <
                 params_.birth_clearance_m;
    });
    if (body != tracks_.end()) {
      use.fate = ObservationFate::kFragment;
      use.track_id = body->id;
      continue;
    }
    Track& track = startTrack(stamp_s, o.position_m, noiseOf(o));
    track.observation = index;
    track.hits = 1;
    track.score = o.score;
    track.history = 1;
    track.status = params_.confirm_hits == 1 ? TrackStatus::kConfirmed : TrackStatus::kTentative;
    use.fate = ObservationFate::kBorn;
    use.track_id = track.id;
    ++report_.born;
    for (const Swap& swap : newcomers_) {
      if (swap.track_b == index)
        report_.swaps.push_back({swap.track_a, track.id, swap.probability});
    }
  }
}

int Tracker::addTrack(const Eigen::Vector2d& position_m) {
  if (!position_m.allFinite()) {
    throw std::invalid_argument("Tracker: the place of a track is not finite");
  }
  if (!stamp_s_) {
    throw std::logic_error("Tracker: a track can't be added before the first step");
  }
  Track& track = startTrack(*stamp_s_, position_m, noise_m2_);
  track.status = TrackStatus::kCoasting;
  return track.id;
}

void Tracker::confirmTrack(int id) {
  const Track* found = findTrack(id);
  if (found == nullptr) {
    throw std::invalid_argument("Tracker: there is no such track");
  }
  Track& track = tracks_[static_cast<std::size_t>(found - tracks_.data())];
  if (track.status == TrackStatus::kTentative) {
    track.status =
        track.observation == Track::kUnseen ? TrackStatus::kCoasting : TrackStatus::kConfirmed;
  }
}

const Track* Tracker::findTrack(int id) const {
  const auto found =
      std::lower_bound(tracks_.begin(), tracks_.end(), id,
                       [](const Track& track, int wanted) { return track.id < wanted; });
  return found != tracks_.end() && found->id == id ? &*found : nullptr;
}

}  // namespace heel
