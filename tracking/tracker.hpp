// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Tracks of everyone in view: the paper's Kalman filters, gating and association (section 3.2).
#pragma once

#include <heel/tracking/assignment.hpp>
#include <heel/tracking/geometric_gate.hpp>
#include <heel/tracking/kalman.hpp>
#include <heel/tracking/observation.hpp>
#include <heel/tracking/track.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace heel {

/// Follows everyone in view. Each observation explains at most one track and each track takes at
/// most one, chosen together at the least cost: squared Mahalanobis distance plus the logarithm of
/// the innovation covariance's determinant, plus a penalty for low score, less twice what looks
/// say. Tentative tracks choose from what the others leave.
///
/// The order of the observations has no influence. Allocates only when there are more observations
/// or tracks than ever before.
class Tracker {
 public:
  /// @param gate  Where a person can be seen; everywhere when empty.
  /// @throws std::invalid_argument  if a parameter is out of range; the text names it.
  explicit Tracker(const TrackerParams& params = {}, GeometricGate gate = {});

  /// Logarithm of the likelihood that an observation (an index) looks as it does if it is a track's
  /// (an id) person, over that of a thing.
  using LookLikelihood = std::function<double(int track_id, int observation)>;

  /// Takes in the observations made at `stamp_s`.
  /// @param looks  Empty: the tracker is blind to looks.
  /// @return What happened; valid until the next call.
  /// @throws std::invalid_argument  if the stamp is not finite.
  const TrackerReport& step(double stamp_s, const std::vector<Observation>& observations,
                            const Viewpoint& viewpoint = {}, const LookLikelihood& looks = {});

  /// Starts a confirmed track at a place where somebody is known to be though nobody saw them, as
  /// of the newest stamp.
  /// @return Its id.
  /// @throws std::invalid_argument  if the place is not finite.
  /// @throws std::logic_error       before the first step.
  int addTrack(const Eigen::Vector2d& position_m);

  /// Makes a tentative track confirmed; no effect on others.
  /// @throws std::invalid_argument  if there is no such track.
  void confirmTrack(int id);

  /// The track of that id, or null; valid until the next call.
  const Track* findTrack(int id) const;

  /// Stamp of the newest frame that was not skipped.
  std::optional<double> stamp_s() const { return stamp_s_; }

  /// All tracks, tentative ones too, in the order of their ids.
  const std::vector<Track>& tracks() const { return tracks_; }
  const TrackerReport& report() const { return report_; }

 private:
  bool advanceTo(double stamp_s);
  void gateObservations(const std::vector<Observation>& observations, const Viewpoint& viewpoint);
  void fillCosts(const std::vector<Observation>& observations, const LookLikelihood& looks);
  void associate(bool tentative);
  void noteSwaps();
  void updateTracks(double stamp_s, const std::vector<Observation>& observations);
  Track& startTrack(double stamp_s, const Eigen::Vector2d& position_m,
                    const Eigen::Matrix2d& noise_m2);
  Eigen::Matrix2d noiseOf(const Observation& seen) const { return noise_m2_ + seen.covariance_m2; }
  void startTracks(double stamp_s, const std::vector<Observation>& observations);
  void endTracks(double stamp_s);

  TrackerParams params_;
  GeometricGate gate_;
  Eigen::Matrix2d noise_m2_;
  double gate_limit_;
  double base_cost_;
  std::optional<double> stamp_s_;
  int next_id_ = 1;
  std::vector<Track> tracks_;
  TrackerReport report_;
  std::vector<int> accepted_;         ///< Indices of observations, ordered by value.
  CostMatrix costs_;                  ///< Of all tracks with these.
  std::vector<int> column_of_track_;  ///< That it took.
  std::vector<bool> is_shared_;       ///< Whether that may be of somebody unseen there, too.
  std::vector<int> rows_, free_;      ///< Tracks that choose, and columns that they choose from.
  CostMatrix choice_;
  std::vector<Swap> newcomers_;  ///< Swaps with who may appear: track_b is an observation's index.
  AssignmentSolver solver_;
  Assignment assignment_;
};

}  // namespace heel
