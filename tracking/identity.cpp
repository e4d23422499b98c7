// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/identity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMistaken = BodyBelief::kMistaken;
const double kLogMistaken = std::log(kMistaken);
constexpr double kPlaceSigma_m = 0.25;  // Of where a person who is tracked is observed next.
constexpr double kRestSigma_m =
    0.5 * BodyBelief::kRest_m;  // Of where whoever rests is observed again.
// Of independent looks at somebody in full view; of people's places in rough homes, 1 in 20.
constexpr double kMissed = 0.05;
constexpr double kRoom_m2 = 20.0;      // Where somebody who is away may be.
constexpr double kUnexpected = 0.02;   // Share of targets who are not where they are expected.
constexpr double kMetLooks = 1.5;      // A stranger is met after so many independent looks.
constexpr double kSurest = 12.0;       // Logarithm of the greatest odds of places and ways.
constexpr double kAlone_m = 1.0;       // Nobody nearer: then a look is theirs alone.
constexpr std::size_t kMostLeft = 32;  // Ended tracks that are remembered: who was seen where.

/// Weights of which the greatest is 1.
Evidence relative(const Evidence& log_weight) { return (log_weight - log_weight.maxCoeff()).exp(); }

}  // namespace

Identity::Identity(TargetLooks looks, const IdentityParams& params, TargetDensity target_density)
    : params_(params),
      target_density_(std::move(target_density)),
      gallery_(std::move(looks), params.gallery),
      clutter_(params.clutter) {
  if (!(params.still_look_s > 0.0 && params.look_way_m > 0.0 && params.stands_s > 0.0 &&
        params.newcomer_density_per_m2 > 0.0 && params.walk_mps > 0.0)) {
    throw std::invalid_argument("IdentityParams: a parameter is not positive");
  }
  left_.reserve(kMostLeft);
}

BodyBelief* Identity::find(int track_id) {
  return const_cast<BodyBelief*>(std::as_const(*this).find(track_id));
}

const BodyBelief* Identity::find(int track_id) const {
  const auto found = std::find_if(beliefs_.begin(), beliefs_.end(),
                                  [&](const BodyBelief& b) { return b.track_id == track_id; });
  return found == beliefs_.end() ? nullptr : &*found;
}

Evidence Identity::probabilities(int track_id) const {
  const BodyBelief* belief = find(track_id);
  return belief == nullptr ? Evidence(Evidence::Zero()) : belief->probability;
}

double Identity::hadTarget(int track_id) const {
  const BodyBelief* belief = find(track_id);
  if (belief == nullptr) return 1.0;
  const double target = belief->targetShare();
  return target + (1.0 - target) * belief->replaced;
}

void Identity::look(const std::vector<Observation>& observations) {
  looks_.resize(observations.size());
  statures_.resize(observations.size());
  if (parts_.size() < observations.size()) parts_.resize(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    gallery_.compare(observations[i], parts_[i]);
    looks_[i] = gallery_.logOdds(parts_[i]);
    looks_[i](kThing, kGarments) -= observations[i].log_person;
    statures_[i] = gallery_.logTallness(observations[i]);
  }
}

double Identity::logLikelihood(int track_id, int observation) const {
  const BodyBelief* belief = find(track_id);
  if (belief == nullptr) return 0.0;
  const Evidence look = looks_[static_cast<std::size_t>(observation)].rowwise().sum();
  const Tallness& stature = statures_[static_cast<std::size_t>(observation)];
  const Tallness before = belief->logTallness();
  const double same = gallery_.logIfAnybody(before + stature) - gallery_.logIfAnybody(before) -
                      gallery_.logIfAnybody(stature);
  // Of a track that may be empty less is expected.
  return std::log((belief->probability * look.exp()).sum() * std::exp(same) + 1e-9) - look[kThing];
}

/// Of everybody, if they are away, per square metre: by where they were seen.
Evidence Identity::densities(const Eigen::Vector2d& place_m, double stamp_s) const {
  // Where somebody was seen counts if it was them, none seen since was, and they have gone.
  Evidence never = Evidence::Ones(), gone = Evidence::Zero(), reaches = Evidence::Zero();
  const auto take = [&](const BodyBelief& body) {
    const double sigma_m = std::hypot(0.3, params_.walk_mps * std::max(stamp_s - body.seen_s, 0.0));
    const double off = (place_m - body.seen_m).norm() / sigma_m;
    const double area_m2 = 2.0 * M_PI * sigma_m * sigma_m;
    const double reach = std::max(kRoom_m2 / area_m2, 1.0) * std::exp(-0.5 * off * off);
    const Evidence counts = (1.0 - body.present) * never * body.seen_as;
    never *= 1.0 - body.seen_as;
    gone += counts;
    reaches += reach * counts;
  };
  std::for_each(beliefs_.begin(), beliefs_.end(), take);
  std::for_each(left_.rbegin(), left_.rend(), take);
  return params_.newcomer_density_per_m2 * (reaches + never) / (gone + never).max(1e-9);
}

/// Of the target, where somebody looks for it. Where a body is in view it is expected because that
/// one may be it, which says nothing of who else comes there.
std::optional<double> Identity::searchDensity(const Eigen::Vector2d& place_m) const {
  const bool is_taken = std::any_of(beliefs_.begin(), beliefs_.end(), [&](const BodyBelief& body) {
    return body.present == 1.0 && (body.place_m - place_m).norm() < kAlone_m;
  });
  if (!target_density_ || is_taken) return std::nullopt;
  const auto density = target_density_(place_m);
  if (!density) return std::nullopt;
  return (1.0 - kUnexpected) * *density + kUnexpected * params_.newcomer_density_per_m2;
}

/// What is believed of somebody who appears at a place, before a look at them.
/// @param but  Whom they come instead of: what was counted of that one is no evidence for another
///             thing, and the target may be looked for there because that one may be it.
Evidence Identity::priorOf(const Eigen::Vector2d& place_m, double stamp_s,
                           const BodyBelief* but) const {
  const ClutterDensity there =
      clutter_.density(place_m, stamp_s, but == nullptr ? ClutterCount{} : but->counted);
  Evidence weight = Evidence::Zero();
  weight[kThing] = there.things_per_m2;
  weight[kStranger] = params_.newcomer_density_per_m2;
  const Evidence density = densities(place_m, stamp_s);
  const auto searched = but == nullptr ? searchDensity(place_m) : std::nullopt;
  weight[kTarget] = searched.value_or(density[kTarget]);
  for (int h = kFirstOther; h < kHypotheses; ++h) {
    if (gallery_.isKnown(h)) weight[h] = density[h];
  }
  // Where people were seen before there are more, whoever they are.
  auto people = weight.tail<kHypotheses - kStranger>();
  people *= 1.0 + there.people_per_m2 / people.sum();
  return weight.max(1e-12).log();
}

/// Where it rests: that it is on its way through a place does not say that things come there, nor
/// people.
void Identity::count(BodyBelief& belief, double time_s, double stamp_s) {
  if (belief.isOnTheWay(stamp_s)) return;
  const double thing_s = time_s * belief.probability[kThing];
  clutter_.add({belief.place_m, time_s, thing_s}, stamp_s);
  belief.counted = {belief.place_m, belief.counted.time_s + time_s,
                    belief.counted.thing_s + thing_s};
}

double IdentityParams::newsOf(double elapsed_s, double way_m) const {
  return -std::expm1(-std::max(elapsed_s, 0.0) / still_look_s - way_m / look_way_m);
}

double Identity::restsFor_s(int track_id, double stamp_s) const {
  const BodyBelief* belief = find(track_id);
  return belief == nullptr ? 0.0 : stamp_s - belief->since_s;
}

/// A track begins: with somebody new, or with whoever has rested there on a track that has ended,
/// for they stay as likely as they did for that share of the time until now.
BodyBelief& Identity::begin(int track_id, const Eigen::Vector2d& place_m, double stamp_s) {
  const Evidence prior = priorOf(place_m, stamp_s);
  // What and who is known to be there is what has rested there: of people, only who comes.
  const double newcomers_per_m2 =
      params_.clutter.density_per_m2 +
      params_.newcomer_density_per_m2 *
          (prior - prior[kStranger]).tail<kHypotheses - kStranger>().exp().sum();
  constexpr double rest_m2 = kRestSigma_m * kRestSigma_m;
  double most_per_m2 = newcomers_per_m2;
  auto same = left_.end();
  for (auto left = left_.begin(); left != left_.end(); ++left) {
    const double off2 = (place_m - left->place_m).squaredNorm() / rest_m2;
    const double per_m2 = left->present * std::exp(-0.5 * off2) / (2.0 * M_PI * rest_m2);
    if (per_m2 <= most_per_m2 || !left->hasRested()) continue;
    most_per_m2 = per_m2;
    same = left;
  }
  BodyBelief& belief = beliefs_.emplace_back();
  if (same != left_.end()) {
    const Evidence another = priorOf(place_m, stamp_s, &*same);
    const double gone = newcomers_per_m2 / (newcomers_per_m2 + most_per_m2);
    part(*same, 1.0, gone);  // They are together again.
    belief = std::move(*same);
    left_.erase(same);
    belief.mixIn(gallery_, {another, another}, gone);
    belief.is_alive = true;
  } else {
    belief.place_m = place_m;
    belief.born_s = belief.since_s = stamp_s;
    belief.log_place = prior;
  }
  belief.track_id = track_id;
  belief.see(place_m, stamp_s);
  return belief;
}

/// Somebody is not seen, at a place where they may be.
void Identity::miss(BodyBelief& belief, const Eigen::Vector2d& place_m, double stamp_s,
                    const Viewpoint& viewpoint) {
  const Sight sight = viewpoint.sight_of ? viewpoint.sight_of(place_m) : Sight::kUnknown;
  if (sight == Sight::kFree) {
    if (belief.missed_looks == 0.0) {
      belief.missed_s = stamp_s;
      belief.missed_from_m = viewpoint.position_m;
    }
    const double way_m = (viewpoint.position_m - belief.missed_from_m).norm();
    belief.missed_looks = 1.0 + params_.newsOf(stamp_s - belief.missed_s, way_m);
  }
  // Whoever stood for a time will for as long, one in two.
  const double stood_s = std::max(belief.seen_s - belief.since_s, BodyBelief::kRests_s);
  const double stays = stood_s / (stood_s + std::max(stamp_s - belief.seen_s, 0.0));
  const double missed = stays * std::pow(kMissed, belief.missed_looks);
  belief.present = missed / (missed + 1.0 - stays);
  belief.in_view = belief.present * (sight == Sight::kOutside ? kMissed : 1.0);
}

/// Where somebody is and goes.
void Identity::takePlace(BodyBelief& belief, const Track& track, const Observation& seen,
                         double stamp_s) {
  const double off_m = (seen.position_m - belief.place_m).norm();
  const bool has_moved = off_m > BodyBelief::restRadius_m(seen);
  const double elapsed_s = std::max(stamp_s - belief.seen_s, 0.0);
  const double news = params_.newsOf(elapsed_s, has_moved ? off_m : 0.0);
  const double there = 2.0 * M_PI * kPlaceSigma_m * kPlaceSigma_m;
  const double clutter = clutter_.density(seen.position_m, stamp_s, belief.counted).things_per_m2;
  const double stood_s = params_.stands_s + std::max(belief.seen_s - belief.since_s, 0.0);
  const double stands = std::log1p(elapsed_s / stood_s);  // -log P(stays | person)
  belief.log_place[kThing] += has_moved ? news * std::log(clutter * there) : stands;
  // Whether it is whoever was there before: else they were missed, and something else came. As
  // long as they are seen, that needs time; else it may have happened at any time.
  const double missed = 1.0 - belief.present + belief.present * kMissed * news;
  if (missed > 0.0) {
    const double same = (1.0 - missed) * track.density_per_m2;
    const Evidence prior = priorOf(seen.position_m, stamp_s, &belief);
    const double other = missed * prior.exp().sum();
    const double other_share = other / (same + other);
    const double target = belief.targetShare();
    const double lost = other_share * target;
    belief.replaced = (lost + (1.0 - target) * belief.replaced) / (lost + 1.0 - target);
    // While they are seen, what tells that they are the target still does.
    if (belief.present < 1.0) part(belief, 0.0, other_share);
    belief.mixIn(gallery_, {prior, prior}, other_share);
  }
  // However long it lasts, nothing is surer than that: who sat for an hour may get up.
  belief.log_place = (belief.log_place - belief.log_place.maxCoeff()).max(-kSurest);
  belief.see(track.motion.position_m(), stamp_s);
  if (has_moved) {
    belief.place_m = seen.position_m;
    belief.since_s = stamp_s;
    belief.counted = {};
  }
}

void Identity::step(double stamp_s, const std::vector<Track>& tracks, const TrackerReport& report,
                    const std::vector<Observation>& observations, const Viewpoint& viewpoint) {
  endBeliefs(tracks);
  if (report.dt_s < 0.0) {  // Of another clock.
    left_.clear();
    seen_s_.setConstant(stamp_s);
    clutter_.setClock(stamp_s);
  }
  for (const Track& track : tracks) {
    BodyBelief* belief = find(track.id);
    if (belief == nullptr || track.observation != Track::kUnseen) continue;
    miss(*belief, track.motion.position_m(), stamp_s, viewpoint);
  }
  for (BodyBelief& left : left_) miss(left, left.place_m, stamp_s, viewpoint);
  for (const Track& track : tracks) {
    if (find(track.id) == nullptr) begin(track.id, track.motion.position_m(), stamp_s);
  }
  mixSwaps(report.swaps);
  for (const Track& track : tracks) {
    if (track.observation == Track::kUnseen) continue;
    BodyBelief& belief = *find(track.id);
    const auto i = static_cast<std::size_t>(track.observation);
    // begin() has taken in where it was seen first.
    if (belief.seen_s != stamp_s) takePlace(belief, track, observations[i], stamp_s);
    if (observations[i].look == nullptr && observations[i].log_person == 0.0) continue;
    const BodyLook look{observations[i], parts_[i], statures_[i], viewpoint.position_m, stamp_s};
    const double elapsed_s = stamp_s - belief.view.since_s;
    belief.takeLook(gallery_, look, params_.newsOf(elapsed_s, belief.wayTo(look)));
  }
  weighTogether();
  seen_s_ = (away_ < 0.5).select(stamp_s, seen_s_);
  remember(tracks, observations);

  const double time_s = std::clamp(report.dt_s, 0.0, 1.0);
  clutter_.look(viewpoint.position_m, viewpoint.sight_of, time_s);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const ObservationUse& use = report.uses[i];
    if (use.fate == ObservationFate::kFragment || use.verdict != GateVerdict::kAccepted) continue;
    if (BodyBelief* belief = find(use.track_id)) {
      count(*belief, time_s, stamp_s);
    } else {
      const Evidence prior = relative(priorOf(observations[i].position_m, stamp_s));
      clutter_.add({observations[i].position_m, time_s, time_s * prior[kThing] / prior.sum()},
                   stamp_s);
    }
  }
}

/// Of bodies that meet nobody can say for sure which observation is whose.
void Identity::mixSwaps(const std::vector<Swap>& swaps) {
  for (const Swap& swap : swaps) {
    BodyBelief* a = find(swap.track_a);
    BodyBelief* b = find(swap.track_b);
    if (a == nullptr || b == nullptr) continue;
    const PastBelief past_a = a->past();
    a->mixIn(gallery_, b->past(), swap.probability);
    b->mixIn(gallery_, past_a, swap.probability);
  }
}

/// However well looks fit the target, it may be a stranger who wears some of the same, which bounds
/// the odds of each garment. Where bodies may have swapped, the odds of all are less than theirs
/// together: then only what is over the bound comes off.
Evidence Identity::logWeight(const BodyBelief& belief) const {
  const LookOdds looks = belief.logLooks();
  const Evidence log_looks = looks.rowwise().sum();
  const double alike = gallery_.logAlike(looks);
  const double most = looks.row(kTarget).head<kGarments>().sum() - alike;
  Evidence log_weight = belief.log_place + belief.log_free + log_looks + belief.log_stature;
  log_weight[kStranger] += std::clamp(log_looks[kTarget] - log_looks[kStranger] - most, 0.0, alike);
  return log_weight;
}

/// Of all beliefs, by themselves.
/// @param may_be_empty  Whether tracks that are not seen may be.
const std::vector<BodyWeights>& Identity::weigh(bool may_be_empty) {
  weights_.resize(beliefs_.size());
  for (std::size_t j = 0; j < beliefs_.size(); ++j) {
    const double present = may_be_empty ? beliefs_[j].in_view : 1.0;
    const Evidence all = relative(logWeight(beliefs_[j]));
    weights_[j] = {present * all, (1.0 - present) * all.sum()};
    for (int h = kFirstOther; h < kHypotheses; ++h) {
      if (!gallery_.isKnown(h)) weights_[j].weight[h] = 0.0;
    }
  }
  return weights_;
}

/// Whoever was in view together with somebody stays another when that one has left; only who came
/// since may be them.
void Identity::weighTogether() {
  const std::vector<Evidence>& together = together_.of(weigh(false));
  double unseen_since_s = kInfinity;
  for (const BodyBelief& belief : beliefs_) {
    if (belief.in_view < 1.0) unseen_since_s = std::min(unseen_since_s, belief.seen_s);
  }
  const std::vector<Evidence>& after =
      unseen_since_s < kInfinity ? after_.of(weigh(true)) : together;
  away_.setOnes();
  for (const bool is_new : {false, true}) {
    for (std::size_t j = 0; j < beliefs_.size(); ++j) {
      BodyBelief& belief = beliefs_[j];
      if ((belief.born_s > unseen_since_s) != is_new) continue;
      belief.probability = is_new ? after[j] : Evidence(belief.in_view * together[j]);
      auto people = belief.probability.tail<kHypotheses - kTarget>();
      people = people.min(away_.tail<kHypotheses - kTarget>());
      away_ = (away_ - belief.probability).max(0.0);
      if (belief.present == 1.0) belief.seen_as = belief.probability;
    }
  }
}

void Identity::endBeliefs(const std::vector<Track>& tracks) {
  for (BodyBelief& belief : beliefs_) {
    belief.is_alive = std::any_of(tracks.begin(), tracks.end(),
                                  [&](const Track& track) { return track.id == belief.track_id; });
  }
  for (BodyBelief& belief : beliefs_) {
    if (!belief.is_alive) leave(belief);
  }
  beliefs_.erase(std::remove_if(beliefs_.begin(), beliefs_.end(),
                                [](const BodyBelief& belief) { return !belief.is_alive; }),
                 beliefs_.end());
}

/// Whoever was in view together with a body is not the person it was, also when that one has gone.
/// This is not known beside a body that was always close to somebody, for it may have been theirs.
/// @param before, gone  Probabilities that its person has gone, so far and from now on.
void Identity::part(const BodyBelief& belief, double before, double gone) {
  if (!belief.was_apart) return;
  const Evidence weight = relative(logWeight(belief));
  Evidence others = (1.0 - weight / weight.sum()).max(kMistaken * kMistaken);
  others.head<kTarget>() = 1.0;
  const auto left = [&](double share) -> Evidence { return others + share * (1.0 - others); };
  const Evidence log_free = (left(before) / left(gone)).log();
  for (BodyBelief& other : beliefs_) {
    if (&other == &belief || !other.is_alive || other.born_s > belief.seen_s) continue;
    other.log_free = (other.log_free + log_free).max(kLogMistaken).min(0.0);
  }
}

/// A track ends.
void Identity::leave(BodyBelief& belief) {
  part(belief, 0.0, 1.0);
  const bool is_known = belief.seen_as.tail<kHypotheses - kTarget>().sum() > kMistaken;
  if (!belief.hasRested() && !is_known) return;
  if (left_.size() == kMostLeft) left_.erase(left_.begin());
  left_.push_back(std::move(belief));
  left_.back().looks = 0.0;  // A portrait takes 60 KB.
  left_.back().sum.resize(0, 0);
}

void Identity::remember(const std::vector<Track>& tracks,
                        const std::vector<Observation>& observations) {
  std::optional<Eigen::Vector2d> target_sure_m;
  for (const Track& track : tracks) {
    if (track.observation != Track::kUnseen && targetProbability(track.id) > 1.0 - kMistaken) {
      target_sure_m = track.motion.position_m();
    }
  }
  for (const Track& track : tracks) {
    if (track.observation == Track::kUnseen) continue;
    BodyBelief& belief = *find(track.id);
    const Eigen::Vector2d place_m = track.motion.position_m();
    const Observation& seen = observations[static_cast<std::size_t>(track.observation)];
    const bool is_alone = std::none_of(tracks.begin(), tracks.end(), [&](const Track& other) {
      return other.id != track.id && (other.motion.position_m() - place_m).norm() < kAlone_m;
    });
    belief.was_apart = belief.was_apart || is_alone;
    int best = 0;
    const bool is_sure = belief.probability.maxCoeff(&best) > 1.0 - kMistaken;
    if (is_sure && best == kTarget) belief.replaced = 0.0;
    if (!is_alone || !is_sure) continue;
    if (best == kStranger) {
      const bool is_another = target_sure_m && (*target_sure_m - place_m).norm() > kAlone_m;
      if (is_another && belief.looks > kMetLooks) meet(belief);
    } else if (best >= kTarget && belief.view.count < View::kMostLooks) {
      // All looks from one side together teach what that view is worth, however long it lasts.
      gallery_.addLookAt(best, seen, parts_[static_cast<std::size_t>(track.observation)],
                         belief.view.weight / View::kMostLooks);
    }
  }
}

/// A stranger becomes one of the others; where there is no room, in the place of whoever has been
/// away for longest.
void Identity::meet(BodyBelief& belief) {
  Eigen::Index longest = 0;
  seen_s_.tail<kMostOthers>().minCoeff(&longest);
  const int replaced = gallery_.isFull() ? kFirstOther + static_cast<int>(longest) : kStranger;
  if (replaced != kStranger && away_[replaced] < 0.5) return;
  Eigen::ArrayXXf mean = belief.sum;
  for (Eigen::Index part = 0; part < mean.cols(); ++part) {
    const float total = mean.col(part).sum();
    if (total > 0.0F) mean.col(part) /= total;
  }
  const int h = gallery_.meet(mean, belief.looks, replaced, belief.logTallness());
  if (h == kStranger) return;
  for (std::vector<BodyBelief>* beliefs : {&beliefs_, &left_}) {
    for (BodyBelief& other : *beliefs) {
      for (Evidence* evidence : {&other.log_place, &other.log_free, &other.log_stature}) {
        (*evidence)[h] = (*evidence)[kStranger];
      }
      for (LookOdds* odds : {&other.log_views, &other.view.mean}) {
        odds->row(h) = odds->row(kStranger);
      }
      other.seen_as[h] = 0.0;
      other.log_place[h] += kLogMistaken;
      if (other.known_parts.size() > 0) other.known_parts.row(h) = 0.0;
    }
  }
  belief.log_place[h] = belief.log_place[kStranger];
  belief.log_place[kStranger] += kLogMistaken;
  std::swap(belief.probability[h], belief.probability[kStranger]);
  belief.seen_as = belief.probability;
  away_[h] = 0.0;
}

void Identity::makeTarget(int track_id, const Eigen::Vector2d& place_m, double stamp_s) {
  BodyBelief* belief = find(track_id);
  if (belief == nullptr) belief = &begin(track_id, place_m, stamp_s);
  for (int h = kThing; h < kHypotheses; ++h) {
    belief->log_place[h] = h < kTarget || gallery_.isKnown(h) ? kLogMistaken : -kSurest;
  }
  belief->log_place[kTarget] = 0.0;
  belief->log_free = belief->log_stature = Evidence::Zero();
  belief->log_views.setZero();
  belief->log_tallness.setZero();
  left_.clear();
  belief->view = {};
  belief->known_looks.resize(0);
  belief->looks = 0.0;
  belief->sum.setZero();
  belief->see(place_m, stamp_s);
  weighTogether();
}

}  // namespace heel
