// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/gallery.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// A bin that a portrait lacks counts as this share of anybody's: nobody was seen from everywhere.
constexpr float kUnseenShare = 0.1F;
constexpr double kMostWeight = 30.0;  // Independent looks; an older one fades as new ones come.
constexpr double kFirstWeight = 3.0;  // What is known beforehand counts for so many.
constexpr double kHeights_m = 1.0;    // What is seen to end over so many metres may be a head.
constexpr double kShortest_m = 1.2, kStep_m = 0.02;    // Of Tallness.
constexpr double kUsual_m = 1.7, kUsualSigma_m = 0.1;  // Statures of people.
// The target's stature through the camera that follows, and its room, differs from phase 1's.
constexpr double kStatureSigma_m = 0.05;
// Makes a misfit's slope of 1 the one between gamma distributions with these means.
constexpr double kMisfitShape = 1.0 / (1.0 / kMisfit - 1.0 / kOthersMisfit);

/// A normal distribution at the steps of Tallness.
Tallness densityOf(double mean_m, double sigma_m) {
  const Tallness statures_m =
      Tallness::LinSpaced(kShortest_m, kShortest_m + kStep_m * (Tallness::SizeAtCompileTime - 1));
  constexpr double kRoot2Pi = 2.5066282746310002;
  return (-0.5 * ((statures_m - mean_m) / sigma_m).square()).exp() / (kRoot2Pi * sigma_m);
}

/// Whether a look, or the mean of some, shows a part.
bool shows(const Eigen::ArrayXXf& look, Eigen::Index part) { return look.col(part).sum() > 0.5F; }

double logMean(const Tallness& log_value, const Tallness& share) {
  const double most = log_value.maxCoeff();
  return most + std::log((share * (log_value - most).exp()).sum());
}

}  // namespace

Gallery::Gallery(TargetLooks looks, const GalleryParams& params)
    : looks_(std::move(looks)), params_(params), people_(kHypotheses) {
  if (!(params.misleading_share >= 1e-6 && params.misleading_share < 1.0 &&
        params.look_correlation >= 0.0 && params.look_correlation <= 1.0)) {
    throw std::invalid_argument("GalleryParams: a parameter is out of its range");
  }
  anybody_statures_ = kStep_m * densityOf(kUsual_m, kUsualSigma_m);
  if (looks_.target.size() == 0) return;
  const Eigen::Index bins = looks_.target.rows();
  if (looks_.room.size() != bins || looks_.anybody.size() != bins) {
    throw std::invalid_argument("TargetLooks: room and anybody need the target's bins");
  }
  if (!(looks_.stature_sigma_m > 0.0)) {
    throw std::invalid_argument("TargetLooks: stature_sigma_m must be positive");
  }
  const auto parts = static_cast<std::size_t>(looks_.target.cols());
  if (looks_.garments.empty()) {
    looks_.garments.resize(parts);
    std::iota(looks_.garments.begin(), looks_.garments.end(), 0);
  }
  if (looks_.garments.size() != parts ||
      std::any_of(looks_.garments.begin(), looks_.garments.end(),
                  [](int garment) { return garment < 0 || garment >= kGarments; })) {
    throw std::invalid_argument("TargetLooks: a part needs one of three garments");
  }
  for (const Tint& tint : looks_.tints) {
    if (tint.bins.size() != bins || tint.bins.minCoeff() < 0 || tint.bins.maxCoeff() >= bins) {
      throw std::invalid_argument("TargetLooks: a light needs one of the bins for each of them");
    }
  }
  // Anybody's colours are seen in this room's light. Things have any colours, as strangers have.
  anybody_ = 0.5F * looks_.anybody + 0.5F * looks_.room;
  anybody_ += 1e-3F / static_cast<float>(bins);
  anybody_ /= anybody_.sum();
  log_anybody_ = anybody_.log();
  Tint same;
  same.bins = Eigen::ArrayXi::LinSpaced(bins, 0, static_cast<int>(bins) - 1);
  looks_.tints.insert(looks_.tints.begin(), same);
  people_[kTarget].portrait = portraitOf(looks_.target, 1.0);
  lately_ = portraitOf(looks_.target, 0.0);
  refresh(people_[kTarget]);
}

Gallery::Portrait Gallery::portraitOf(const Eigen::ArrayXXf& mean, double weight) const {
  Portrait portrait{mean, mean, mean, std::vector<bool>(static_cast<std::size_t>(mean.cols())),
                    weight};
  for (Eigen::Index part = 0; part < mean.cols(); ++part) refresh(portrait, part);
  return portrait;
}

/// After a change of a part's mean.
void Gallery::refresh(Portrait& portrait, Eigen::Index part) const {
  const auto mean = portrait.mean.col(part);
  auto like = portrait.log_like.col(part);
  like.setZero();
  for (Eigen::Index bin = 0; bin < mean.size(); ++bin) {
    if (mean[bin] <= 0.0F) continue;
    const float share = mean[bin] / static_cast<float>(looks_.tints.size());
    for (const Tint& tint : looks_.tints) like[tint.bins[bin]] += share;
  }
  const auto logShares = [this](const auto& shares) {
    return ((shares + kUnseenShare * anybody_) / (1.0F + kUnseenShare)).log();
  };
  portrait.log_shares.col(part) = logShares(mean);
  like = logShares(like);
  portrait.knows[static_cast<std::size_t>(part)] = shows(portrait.mean, part);
}

void Gallery::refresh(Person& person) const {
  if (person.misfit.size() == 0) {
    person.misfit.setConstant(person.portrait.mean.cols(), kMisfit);
    person.misfit_weight.setConstant(person.portrait.mean.cols(), kFirstWeight);
  }
  const bool is_told = &person == &people_[kTarget] && looks_.stature_m;
  person.statures = is_told ? densityOf(*looks_.stature_m, kStatureSigma_m) : anybody_statures_;
  person.statures *= person.log_tallness.exp();
  person.statures /= person.statures.sum();
}

/// @param is_seen  Is set to 1 of the parts that the look shows.
void Gallery::takeApart(const Eigen::ArrayXXf& look, Eigen::ArrayXd& is_seen) {
  look_.clear();
  ends_.clear();
  entropies_.clear();
  for (Eigen::Index part = 0; part < look.cols(); ++part) {
    double entropy = 0.0;
    const std::size_t begin = look_.size();
    for (Eigen::Index bin = 0; bin < look.rows(); ++bin) {
      const float share = look(bin, part);
      if (share <= 0.0F) continue;
      look_.push_back({static_cast<int>(bin), share});
      entropy += static_cast<double>(share * std::log(share));
    }
    if (look_.size() > begin) is_seen[part] = 1.0;
    ends_.push_back(look_.size());
    entropies_.push_back(entropy);
  }
}

/// A part of the look at hand in a light.
/// @param log_shares  The portrait's, or those of its like.
Gallery::PartFit Gallery::fitOf(const Fit& fit, const Eigen::ArrayXXf& log_shares,
                                std::size_t part) const {
  const std::size_t begin = part == 0 ? 0 : ends_[part - 1];
  if (begin == ends_[part] || !fit.portrait->knows[part]) return {};
  const auto person = log_shares.col(static_cast<Eigen::Index>(part));
  float mean = 0.0F, anybody = 0.0F;
  for (std::size_t n = begin; n < ends_[part]; ++n) {
    const int bin = fit.tint->bins[look_[n].bin];
    mean += look_[n].share * person[bin];
    anybody += look_[n].share * log_anybody_[bin];
  }
  const double misfit = std::max(entropies_[part] - mean, 0.0);
  return {misfit, kLikenessOffset + kRarityShare * (entropies_[part] - anybody) - misfit};
}

/// What a misfit says against somebody who usually has another. Whoever usually fits worse than
/// people do is judged as people are; and it is never for them: things of their colours may fit.
double Gallery::against(const Person& person, double misfit, std::size_t part) const {
  const double usual = std::min(person.misfit[static_cast<Eigen::Index>(part)], kMisfit);
  const double odds = misfit * (1.0 / usual - 1.0 / kMisfit) - std::log(kMisfit / usual);
  return std::clamp(kMisfitShape * odds, 0.0, -std::log(params_.misleading_share));
}

/// In the light that fits best.
Gallery::Fit Gallery::bestFit(const Person& person, const Portrait& portrait,
                              double log_share) const {
  Fit best;
  for (const Tint& tint : looks_.tints) {
    Fit fit{&portrait, &tint, log_share + tint.log_prior};
    for (std::size_t part = 0; part < ends_.size(); ++part) {
      const PartFit its = fitOf(fit, portrait.log_shares, part);
      fit.log_odds += its.log_odds - against(person, its.misfit, part);
    }
    if (fit.log_odds > best.log_odds) best = fit;
  }
  return best;
}

Tallness Gallery::logTallness(const Observation& seen) const {
  if (!looks_.stature_m || !seen.stature_m) return Tallness::Zero();
  // A lintel over them, or a hand, may be taken for their head.
  const double mislead = params_.misleading_share;
  const double sigma_m = looks_.stature_sigma_m;
  return ((1.0 - mislead) * densityOf(*seen.stature_m, sigma_m) + mislead / kHeights_m).log();
}

Evidence Gallery::logLikelihood(const Tallness& log_tallness) const {
  Evidence evidence = Evidence::Zero();
  if (log_tallness.isZero()) return evidence;
  const double anybody = logIfAnybody(log_tallness);
  constexpr double kEqually = 1.0 / Tallness::SizeAtCompileTime;
  evidence[kThing] = logMean(log_tallness, Tallness::Constant(kEqually)) - anybody;
  for (int h = kTarget; h < kHypotheses; ++h) {
    if (isKnown(h)) evidence[h] = logMean(log_tallness, people_[index(h)].statures) - anybody;
  }
  return evidence;
}

double Gallery::logIfAnybody(const Tallness& log_tallness) const {
  return logMean(log_tallness, anybody_statures_);
}

void Gallery::compare(const Observation& seen, LookEvidence& evidence) {
  evidence.light.setZero();
  evidence.parts.setZero(kHypotheses, looks_.target.cols());
  evidence.misfits.setConstant(kHypotheses, looks_.target.cols(), -1.0);
  evidence.is_seen.setZero(looks_.target.cols());
  if (seen.look == nullptr || anybody_.size() == 0) return;
  if (seen.look->rows() != looks_.target.rows() || seen.look->cols() != looks_.target.cols()) {
    throw std::invalid_argument("Gallery: a look needs the target's bins and parts");
  }
  takeApart(*seen.look, evidence.is_seen);
  for (int h = kTarget; h < kHypotheses; ++h) {
    if (!isKnown(h)) continue;
    // Half of the target is what was seen lately, as that comes to rest on more.
    const double lately =
        h == kTarget ? 0.5 * lately_.weight / (lately_.weight + kFirstWeight) : 0.0;
    const Person& person = people_[index(h)];
    Fit fit = bestFit(person, person.portrait, std::log1p(-lately));
    evidence.light[h] = fit.log_odds;
    if (lately > 0.0) {
      const Fit other = bestFit(person, lately_, std::log(lately));
      evidence.light[h] += std::log1p(std::exp(other.log_odds - fit.log_odds));
      if (other.log_odds > fit.log_odds) fit = other;
    }
    for (std::size_t part = 0; part < ends_.size(); ++part) {
      const auto column = static_cast<Eigen::Index>(part);
      const PartFit its = fitOf(fit, fit.portrait->log_shares, part);
      evidence.parts(h, column) = its.log_odds - against(person, its.misfit, part);
      evidence.misfits(h, column) = its.misfit;
      if (h != kTarget) continue;
      evidence.parts(kStranger, column) = fitOf(fit, fit.portrait->log_like, part).log_odds;
    }
    evidence.light[h] -= evidence.parts.row(h).sum();
  }
}

LookOdds Gallery::logOdds(const LookEvidence& look, const Eigen::ArrayXXd* known) const {
  LookOdds odds = LookOdds::Zero();
  if (!(look.is_seen > 0.0).any()) return odds;
  Evidence sums = Evidence::Zero();
  for (int h = kStranger; h < kHypotheses; ++h) {
    const int who = std::max<int>(h, kTarget);  // The like is seen in the target's light.
    if (!isKnown(who)) continue;
    auto garments = odds.row(h).head<kGarments>();
    for (Eigen::Index part = 0; part < look.parts.cols(); ++part) {
      garments[looks_.garments[static_cast<std::size_t>(part)]] +=
          look.is_seen[part] > 0.0 || known == nullptr ? look.parts(h, part) : (*known)(h, part);
    }
    const double sum = look.light[who] + garments.sum();
    // Fewer looks are like somebody by chance than are unlike themselves.
    const double mislead = params_.misleading_share, alike = mislead * mislead;
    const double ratio = std::exp(std::min(sum, 100.0));
    const double bounded =
        std::log(((1.0 - mislead) * ratio + mislead) / (1.0 - alike + alike * ratio));
    constexpr double kNothing = 1e-6;  // Nearer to 0 the share is the slope there.
    garments *= std::abs(sum) > kNothing ? bounded / sum : 1.0 - mislead - alike;
    if (h != kStranger) sums[h] = bounded;
  }
  setSums(odds, sums);
  return odds;
}

double Gallery::logAlike(const LookOdds& odds) const {
  const double share = params_.misleading_share;
  const auto like = odds.row(kStranger).head<kGarments>();
  const double some = (1.0 - share + share * like.min(100.0).exp()).log().max(0.0).sum();
  const double all = std::exp(std::min(like.sum() - some, 100.0));
  return std::max(some + std::log1p(share * share * (all - 1.0)), 0.0);
}

void Gallery::addLookAt(int hypothesis, const Observation& seen, const LookEvidence& evidence,
                        double weight) {
  if (seen.look == nullptr || !isKnown(hypothesis)) return;
  Person& person = people_[index(hypothesis)];
  for (Eigen::Index part = 0; part < evidence.misfits.cols(); ++part) {
    const double misfit = evidence.misfits(hypothesis, part);
    if (misfit < 0.0) continue;
    double& rests_on = person.misfit_weight[part];
    rests_on = std::min(rests_on + weight, kMostWeight);
    person.misfit[part] += weight / rests_on * (misfit - person.misfit[part]);
  }
  if (seen.stature_m) {
    person.log_tallness +=
        weight * (logTallness(seen) - params_.look_correlation * person.log_tallness);
  }
  refresh(person);
  if (!(evidence.is_seen > 0.0).any()) return;
  Portrait& portrait = hypothesis == kTarget ? lately_ : person.portrait;
  portrait.weight = std::min(portrait.weight + weight, kMostWeight);
  const auto gain = static_cast<float>(weight / portrait.weight);
  for (Eigen::Index part = 0; part < seen.look->cols(); ++part) {
    if (!shows(*seen.look, part)) continue;
    const float keep = shows(portrait.mean, part) ? 1.0F - gain : 0.0F;
    portrait.mean.col(part) = keep * portrait.mean.col(part) + (1.0F - keep) * seen.look->col(part);
    refresh(portrait, part);
    // What phase 1 did not show is as it was seen since.
    if (hypothesis == kTarget && !shows(looks_.target, part)) {
      person.portrait.mean.col(part) = portrait.mean.col(part);
      refresh(person.portrait, part);
    }
  }
}

int Gallery::meet(const Eigen::ArrayXXf& mean_look, double weight, int replaced,
                  const Tallness& log_tallness) {
  int hypothesis = replaced;
  for (int h = kFirstOther; hypothesis == kStranger && h < kHypotheses; ++h) {
    if (!isKnown(h)) hypothesis = h;
  }
  if (hypothesis < kFirstOther || anybody_.size() == 0) return kStranger;
  Person& person = people_[index(hypothesis)];
  person = {};
  person.portrait = portraitOf(mean_look, weight);
  person.log_tallness = log_tallness;
  refresh(person);
  return hypothesis;
}

}  // namespace heel
