// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who is who: what is believed of each track, by Bayes, over time.
#pragma once

#include <heel/tracking/clutter_map.hpp>
#include <heel/tracking/gallery.hpp>
#include <heel/tracking/geometric_gate.hpp>
#include <heel/tracking/track.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
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

/// Where somebody was seen last.
struct Absence {
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
  double seen_s = 0.0;
  double probability = 0.0;  ///< That it was them,
  int track_id = 0;          ///< who were on this track.
};

/// Believes of each track of a Tracker that it is a thing, a stranger, the target or one of the
/// others who were met. Looks, places and ways are evidence; of several tracks at one time only one
/// can be the target, and only one each other person; each may be away.
///
/// Allocates for a new track, and when somebody is met.
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
  void step(double stamp_s, double dt_s, const std::vector<Track>& tracks,
            const TrackerReport& report, const std::vector<Observation>& observations,
            const Viewpoint& viewpoint);

  /// This track is the target, whatever was believed.
  void makeTarget(int track_id, const Eigen::Vector2d& place_m, double stamp_s);

  /// Probabilities of a track's hypotheses: that they are there, so that less than 1 is left where
  /// nobody is seen any more. Of a track that is not known, all 0.
  Evidence probabilities(int track_id) const;
  /// That the target is there now: a track that is not seen where it should be has lost somebody.
  double targetProbability(int track_id) const;
  /// That the target is who is on a track, or was, and somebody else has come in their place; 1
  /// where the track has ended.
  double hadTarget(int track_id) const;
  /// For how long a track has not left its place.
  double restsFor_s(int track_id, double stamp_s) const;
  /// Probability that the target is none of the tracks.
  double away() const { return away_[kTarget]; }
  /// What the looks of the last step said, observation by observation, without statures.
  const std::vector<Evidence>& looks() const { return looks_; }

 private:
  /// Looks from one side at somebody at one place: their mean says what one look does, but better.
  struct View {
    Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d ray_m = Eigen::Vector2d::Zero();  ///< From the camera.
    double since_s = 0.0;
    double weight = 0.0;  ///< As far as it is another view than the one before.
    Evidence mean = Evidence::Zero();
    Tallness tallness = Tallness::Zero();  ///< The mean, too.
    double count = 0.0;
    Evidence evidence() const { return weight * mean; }
  };

  /// What is believed of a body before it is seen again.
  struct Past {
    Evidence log_place = Evidence::Zero();
    Evidence log_all = Evidence::Zero();   ///< By all but statures,
    Evidence log_view = Evidence::Zero();  ///< and of it by the view at hand.
    Tallness log_tallness = Tallness::Zero(), log_view_tallness = Tallness::Zero();
  };

  struct Belief {
    int track_id = 0;
    Evidence log_place = Evidence::Zero();  ///< By where it came from and goes.
    Evidence log_views = Evidence::Zero();  ///< By looks from all views but the present one.
    /// By who was somebody else in view at the same time, and has left.
    Evidence log_free = Evidence::Zero();
    Evidence probability = Evidence::Zero();            ///< With who is in view now, too.
    Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< Where it rests, or was lately,
    double since_s = 0.0;                               ///< since then;
    ClutterCount counted;                               ///< of it there, in that time.
    double born_s = 0.0;                                ///< Seen first,
    double seen_s = 0.0;                                ///< and last.
    View view;
    double looks = 0.0;   ///< Independent ones, and the sum of all, since it was surely
    Eigen::ArrayXXf sum;  ///< the same body.
    /// Of all views but the present one, and what all views say of it: a stature is one fact.
    Tallness log_tallness = Tallness::Zero();
    Evidence log_stature = Evidence::Zero();
    /// Means of what looks said of each part, so that one that is out of view still counts,
    Eigen::ArrayXXd known_parts;
    Eigen::ArrayXd known_looks;  ///< of so many looks.
    double present = 1.0;        ///< Probability that whoever it is still is there.
    double replaced = 0.0;       ///< Unless it is the target: that it was, before another came.
    bool was_apart = false;      ///< At some time nobody else was near.
    bool is_alive = true;

    Tallness logTallness() const { return log_tallness + view.weight * view.tallness; }
    double targetShare() const {
      return probability[kTarget] / std::max(probability.sum(), 1e-300);
    }
    Evidence logLooks() const { return log_views + view.evidence() + log_stature; }
    Past past() const {
      return {log_place, log_place + log_free + log_views + view.evidence(), view.evidence(),
              logTallness(), view.weight * view.tallness};
    }
  };

  Belief* find(int track_id);
  const Belief* find(int track_id) const;
  Belief& begin(int track_id, const Eigen::Vector2d& place_m, double stamp_s);
  double densityOf(int h, const Eigen::Vector2d& place_m, double stamp_s) const;
  Evidence priorOf(const Eigen::Vector2d& place_m, double stamp_s,
                   const ClutterCount& but = {}) const;
  void count(Belief& belief, double time_s, double stamp_s);
  void takePlace(Belief& belief, const Track& track, const Observation& seen, double stamp_s);
  void takeLook(Belief& belief, const Observation& seen, std::size_t look,
                const Eigen::Vector2d& eye_m, double stamp_s);
  Tallness mixed(const Tallness& own, const Tallness& other, double other_share) const;
  void mixIn(Belief& belief, const Past& other, double other_share);
  void mixSwaps(const std::vector<Swap>& swaps);
  void weighTogether();
  void weigh(bool is_left, std::vector<Evidence>& marginals);
  void endBeliefs(const std::vector<Track>& tracks);
  Evidence logWeight(const Belief& belief) const;
  Evidence logOthers(const Belief& belief) const;
  void leave(Belief& belief);
  void remember(const std::vector<Track>& tracks, const std::vector<Observation>& observations,
                double stamp_s);
  void meet(Belief& belief);

  IdentityParams params_;
  TargetDensity target_density_;
  Gallery gallery_;
  ClutterMap clutter_;
  std::vector<Belief> beliefs_;
  std::vector<Belief> left_;                  // of tracks that have ended, the last one last
  std::vector<Evidence> looks_;               // of the step's observations, alone,
  std::vector<LookEvidence> parts_;           // and part by part,
  std::vector<Tallness> statures_;            // and of these
  Evidence away_ = Evidence::Ones();          // of each person, that they are none of the tracks
  std::vector<std::optional<Absence>> last_;  // where each was seen last
  struct Weights {
    Evidence weight;
    double nobody = 0.0;  // that it is empty
  };
  std::vector<Weights> weights_;
  std::vector<double> forward_, backward_;
  std::vector<Evidence> together_, after_;  // marginals, see weighTogether()
};

}  // namespace heel
