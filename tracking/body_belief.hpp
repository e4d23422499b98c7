// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What is believed of one body, and how looks and doubts change it. Identity keeps one for each
/// track.
#pragma once

#include <heel/tracking/clutter_map.hpp>
#include <heel/tracking/gallery.hpp>
#include <heel/tracking/observation.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {

/// A look at a body, and what it says.
struct BodyLook {
  const Observation& seen;
  const LookEvidence& parts;  ///< By its colours, part by part,
  const Tallness& tallness;   ///< and by its stature.
  Eigen::Vector2d eye_m;      ///< Where the camera was,
  double stamp_s;             ///< and when.
};

/// Looks from one side at somebody at one place: their mean says what one look does, but better.
struct View {
  static constexpr double kMostLooks =
      10.0;  ///< So many of the last make its mean, or are learned.
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d ray_m = Eigen::Vector2d::Zero();  ///< From the camera.
  double since_s = -std::numeric_limits<double>::infinity();
  double weight = 0.0;  ///< As far as it is another view than the one before; 0: there is none.
  LookOdds mean = LookOdds::Zero();      ///< Of what looks say of colours,
  Tallness tallness = Tallness::Zero();  ///< and of statures.
  double count = 0.0;                    ///< Looks in the means, those that show colours,
  double tallness_count = 0.0;           ///< and a stature;
  double thing_count = 0.0;              ///< in the mean of a thing all looks.
  LookOdds evidence() const { return weight * mean; }
};

/// What is believed of a body before it is seen again.
struct PastBelief {
  Evidence log_place = Evidence::Zero();
  Evidence log_all = Evidence::Zero();  ///< By all but statures,
  /// of it by looks, and of these by the view at hand; the same of statures.
  LookOdds log_looks = LookOdds::Zero(), log_view = LookOdds::Zero();
  Tallness log_tallness = Tallness::Zero(), log_view_tallness = Tallness::Zero();
};

/// Logarithms of what is believed of a body, each by its cause.
struct BodyBelief {
  static constexpr double kRest_m = 0.2;  ///< Whoever is no further off has not moved.
  /// The same of somebody whose observation is not exact.
  static double restRadius_m(const Observation& seen) {
    return kRest_m + 2.0 * std::sqrt(seen.covariance_m2.trace());
  }
  static constexpr double kRests_s = 1.0;  ///< Nobody who walks stays that near for so long.
  /// Of the identities that seem sure, or that one is told, so many are wrong.
  static constexpr double kMistaken = 0.01;

  int track_id = 0;
  Evidence log_place = Evidence::Zero();  ///< By where it came from and goes.
  LookOdds log_views = LookOdds::Zero();  ///< By looks from all views but the present one.
  /// By who was somebody else in view at the same time, and has left.
  Evidence log_free = Evidence::Zero();
  Evidence probability = Evidence::Zero();            ///< With who is in view now, too.
  Evidence seen_as = Evidence::Zero();                ///< The same, when it was seen last.
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< Where it rests, or was lately,
  double since_s = 0.0;                               ///< since then;
  ClutterCount counted;                               ///< of it there, in that time.
  double born_s = 0.0;                                ///< Seen first,
  double seen_s = 0.0;                                ///< and last,
  Eigen::Vector2d seen_m = Eigen::Vector2d::Zero();   ///< there.
  View view;
  double looks = 0.0;   ///< Independent ones, and the sum of all, since it was surely
  Eigen::ArrayXXf sum;  ///< the same body.
  /// Of all views but the present one, and what all views say of it: a stature is one fact.
  Tallness log_tallness = Tallness::Zero();
  Evidence log_stature = Evidence::Zero();
  /// Means of what looks said of each part, so that one that is out of view still counts,
  Eigen::ArrayXXd known_parts;
  Eigen::ArrayXd known_looks;  ///< of so many looks.
  double present = 1.0;        ///< Probability that whoever it is still is there,
  double in_view = 1.0;        ///< and that they are there and in the picture.
  double missed_looks = 0.0;   ///< Independent ones that did not find them in full view, of which
  double missed_s = 0.0;       ///< the first was then,
  Eigen::Vector2d missed_from_m = Eigen::Vector2d::Zero();  ///< with the camera there.
  double replaced = 0.0;   ///< Unless it is the target: that it was, before another came.
  bool was_apart = false;  ///< At some time nobody else was near.
  bool is_alive = true;

  Tallness logTallness() const { return log_tallness + view.weight * view.tallness; }
  LookOdds logLooks() const { return log_views + view.evidence(); }
  double targetShare() const { return probability[kTarget] / std::max(probability.sum(), 1e-300); }
  PastBelief past() const;

  /// It has moved, and rests nowhere yet.
  bool isOnTheWay(double stamp_s) const { return since_s > born_s && stamp_s - since_s < kRests_s; }
  /// Where it was seen last it was more than once, and not on its way.
  bool hasRested() const { return seen_s > since_s && !isOnTheWay(seen_s); }

  /// The way [m] from the view at hand to a look, by body or camera; 0 if neither may have moved.
  double wayTo(const BodyLook& look) const;

  /// They are seen again.
  void see(const Eigen::Vector2d& at_m, double stamp_s) {
    seen_m = at_m;
    seen_s = stamp_s;
    present = in_view = 1.0;
    missed_looks = 0.0;
  }

  /// Takes in a look, of which so much is new.
  void takeLook(const Gallery& gallery, const BodyLook& look, double news);

  /// With a probability it is another body than before, of which `other` is believed. Past looks
  /// then say whatever the place does not, so that as they fade the place is left.
  void mixIn(const Gallery& gallery, const PastBelief& other, double other_share);
};

}  // namespace heel
