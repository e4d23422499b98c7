// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/body_belief.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

constexpr double kOtherView = 0.5;  // A look with so much news begins another view.

/// Evidence as it is left if it is about somebody else with a probability.
Evidence mix(const Evidence& own, const Evidence& other, double other_share) {
  return other_share > 0.0 ? Evidence(((1.0 - other_share) * own.exp() / own.exp().sum() +
                                       other_share * other.exp() / other.exp().sum())
                                          .log())
                           : own;
}

/// The same, each garment by itself, too: it is somebody's or is not.
LookOdds mix(const LookOdds& own, const LookOdds& other, double other_share) {
  const auto isTheirs = [](const LookOdds& odds) { return 1.0 / (1.0 + (-odds).exp()); };
  LookOdds mixed = (((1.0 - other_share) * isTheirs(own) + other_share * isTheirs(other)) /
                    ((1.0 - other_share) * isTheirs(-own) + other_share * isTheirs(-other)))
                       .log();
  setSums(mixed, mix(Evidence(own.rowwise().sum()), Evidence(other.rowwise().sum()), other_share));
  return mixed;
}

Tallness mix(const Gallery& gallery, const Tallness& own, const Tallness& other,
             double other_share) {
  return ((1.0 - other_share) * (own - gallery.logIfAnybody(own)).exp() +
          other_share * (other - gallery.logIfAnybody(other)).exp())
      .log();
}

}  // namespace

PastBelief BodyBelief::past() const {
  const LookOdds log_looks = logLooks();
  return {log_place,     log_place + log_free + log_looks.rowwise().sum(),
          log_looks,     view.evidence(),
          logTallness(), view.weight * view.tallness};
}

double BodyBelief::wayTo(const BodyLook& look) const {
  const Eigen::Vector2d ray_m = look.seen.position_m - look.eye_m;
  const double way_m =
      std::max((look.seen.position_m - view.place_m).norm(), (ray_m - view.ray_m).norm());
  return way_m > restRadius_m(look.seen) ? way_m : 0.0;
}

void BodyBelief::takeLook(const Gallery& gallery, const BodyLook& look, double news) {
  if (news > kOtherView) {
    const double keep = std::exp(-gallery.params().look_correlation * news);
    log_views = keep * logLooks();
    if (view.tallness_count > 0.0) log_tallness = keep * logTallness();
    view = View{look.seen.position_m, look.seen.position_m - look.eye_m, look.stamp_s, news};
  }
  view.thing_count = std::min(view.thing_count + 1.0, View::kMostLooks);
  double& thing = view.mean(kThing, kGarments);
  thing += (-look.seen.log_person - thing) / view.thing_count;
  if (look.seen.look == nullptr) return;  // Depth or the outline tells that it is no person, say.
  if (view.count == 0.0) looks += view.weight;
  view.count = std::min(view.count + 1.0, View::kMostLooks);
  const LookEvidence& parts = look.parts;
  if (known_looks.size() == 0) {
    known_parts.setZero(kHypotheses, parts.is_seen.size());
    known_looks.setZero(parts.is_seen.size());
  }
  const LookOdds odds = gallery.logOdds(parts, &known_parts);
  known_looks = (known_looks + parts.is_seen).min(View::kMostLooks);
  known_parts +=
      (parts.parts - known_parts).rowwise() * (parts.is_seen / known_looks.max(1.0)).transpose();
  auto people = view.mean.bottomRows<kHypotheses - kStranger>();
  people += (odds.bottomRows<kHypotheses - kStranger>() - people) / view.count;
  if (look.seen.stature_m) {
    view.tallness_count = std::min(view.tallness_count + 1.0, View::kMostLooks);
    view.tallness += (look.tallness - view.tallness) / view.tallness_count;
  }
  log_stature = gallery.logLikelihood(logTallness());
  if (sum.size() == 0) sum.setZero(look.seen.look->rows(), look.seen.look->cols());
  sum += *look.seen.look;
}

void BodyBelief::mixIn(const Gallery& gallery, const PastBelief& other, double other_share) {
  if (other_share > kMistaken) {  // A portrait is of one body.
    looks = 0.0;
    sum.setZero();
  }
  known_parts *= 1.0 - other_share;
  const PastBelief own = past();
  const Evidence all = mix(own.log_all, other.log_all, other_share);
  log_place = mix(own.log_place, other.log_place, other_share);
  log_free *= 1.0 - other_share;
  if (view.weight > 0.0) {
    view.mean = mix(own.log_view, other.log_view, other_share) / view.weight;
    view.mean.col(kGarments) -= view.mean.row(kStranger).sum();
    view.tallness =
        mix(gallery, own.log_view_tallness, other.log_view_tallness, other_share) / view.weight;
    view.count *= 1.0 - other_share;
    view.tallness_count *= 1.0 - other_share;
    view.thing_count *= 1.0 - other_share;
  }
  log_views = mix(own.log_looks, other.log_looks, other_share) - view.evidence();
  setSums(log_views, all - log_place - log_free - view.evidence().rowwise().sum());
  log_tallness =
      mix(gallery, own.log_tallness, other.log_tallness, other_share) - view.weight * view.tallness;
  log_stature = gallery.logLikelihood(logTallness());
}

}  // namespace heel
