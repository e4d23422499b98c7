// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who is who: what is believed of each track, by Bayes, over time.
#pragma once

#include <heel/tracking/body_belief.hpp>
#include <heel/tracking/clutter_map.hpp>
#include <heel/tracking/gallery.hpp>
#include <heel/tracking/geometric_gate.hpp>
#include <heel/tracking/joint_marginals.hpp>
#include <heel/tracking/track.hpp>

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

namespace heel {

/// How much looks, ways and absences count as evidence.
struct IdentityParams {
  GalleryParams gallery;
  ClutterMapParams clutter;
  /// While neither the body nor the camera moves, one look in this time counts as new.
  double still_look_s = 30.0;
  /// While the body or the camera moves, one look in this way counts as new.
  double look_way_m = 0.5;
  /// Somebody who has stood for a time is expected to stand for that time and this longer; things
  /// stay.
  double stands_s = 10.0;
  /// Strangers who come into view per square metre and look; things are counted elsewhere
  /// (ClutterMapParams). The target, and each of the others, come as often while they are away.
  double newcomer_density_per_m2 = 0.05;
  /// Speed at which somebody out of view gets away from where they were last seen.
  double walk_mps = 1.0;

  /// How much of a look is new, after a time and a way.
  double newsOf(double elapsed_s, double way_m) const;
};

/// Probability density [1/m²] of where the target is while nobody sees them, by whoever looks for
/// them; absent: not known. Then they may have walked anywhere from where they were seen last.
using TargetDensity = std::function<std::optional<double>(const Eigen::Vector2d& place_m)>;

/// Believes of each track of a Tracker that it is a thing, a stranger, the target or one of the
/// others who were met. Looks, places and ways are evidence; of several tracks at one time only one
/// can be the target, and only one each other person; each may be away.
///
/// Allocates for a new track, when one ends, and when somebody is met.
class Identity {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit Identity(TargetLooks looks = {}, const IdentityParams& params = {},
                    TargetDensity target_density = {});

  /// Takes the looks in; call it before the tracker's step, so that it can ask logLikelihood().
  void look(const std::vector<Observation>& observations);

  /// Of an observation being the next of a track, as far as looks go: over that of a thing.
  double logLikelihood(int track_id, int observation) const;

  /// Takes in what the tracker made of them.
  void step(double stamp_s, const std::vector<Track>& tracks, const TrackerReport& report,
            const std::vector<Observation>& observations, const Viewpoint& viewpoint);

  /// This track is the target, whatever was believed.
  void makeTarget(int track_id, const Eigen::Vector2d& place_m, double stamp_s);

  /// Probabilities of a track's hypotheses: that they are there, so that less than 1 is left where
  /// nobody is seen any more. Of a track that is not known, all 0.
  Evidence probabilities(int track_id) const;
  /// That the target is there now: a track that is not seen where it should be has lost somebody.
  double targetProbability(int track_id) const { return probabilities(track_id)[kTarget]; }
  /// That the target is who is on a track, or was, and somebody else has come in their place; 1
  /// where the track has ended.
  double hadTarget(int track_id) const;
  /// For how long a track has not left its place.
  double restsFor_s(int track_id, double stamp_s) const;
  /// Probability that the target is none of the tracks.
  double away() const { return away_[kTarget]; }
  /// What the looks of the last step said, observation by observation, without statures.
  const std::vector<LookOdds>& looks() const { return looks_; }

 private:
  BodyBelief* find(int track_id);
  const BodyBelief* find(int track_id) const;
  BodyBelief& begin(int track_id, const Eigen::Vector2d& place_m, double stamp_s);
  Evidence densities(const Eigen::Vector2d& place_m, double stamp_s) const;
  std::optional<double> searchDensity(const Eigen::Vector2d& place_m) const;
  Evidence priorOf(const Eigen::Vector2d& place_m, double stamp_s,
                   const BodyBelief* but = nullptr) const;
  void count(BodyBelief& belief, double time_s, double stamp_s);
  void miss(BodyBelief& belief, const Eigen::Vector2d& place_m, double stamp_s,
            const Viewpoint& viewpoint);
  void takePlace(BodyBelief& belief, const Track& track, const Observation& seen, double stamp_s);
  void mixSwaps(const std::vector<Swap>& swaps);
  void weighTogether();
  const std::vector<BodyWeights>& weigh(bool may_be_empty);
  void endBeliefs(const std::vector<Track>& tracks);
  Evidence logWeight(const BodyBelief& belief) const;
  void part(const BodyBelief& belief, double before, double gone);
  void leave(BodyBelief& belief);
  void remember(const std::vector<Track>& tracks, const std::vector<Observation>& observations);
  void meet(BodyBelief& belief);

  IdentityParams params_;
  TargetDensity target_density_;
  Gallery gallery_;
  ClutterMap clutter_;
  std::vector<BodyBelief> beliefs_;
  std::vector<BodyBelief> left_;        // of tracks that have ended, the last one last
  std::vector<LookOdds> looks_;         // of the step's observations, alone,
  std::vector<LookEvidence> parts_;     // and part by part,
  std::vector<Tallness> statures_;      // and of these
  Evidence away_ = Evidence::Ones();    // of each person, that they are none of the tracks,
  Evidence seen_s_ = Evidence::Zero();  // and when they were seen last
  std::vector<BodyWeights> weights_;
  JointMarginals together_, after_;  // see weighTogether()
};

}  // namespace heel
