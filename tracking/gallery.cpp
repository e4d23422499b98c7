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
  // Whoever usually fits worse than people do is judged as people are.
  person.rate_gain = (1.0 / person.misfit - 1.0 / kMisfit).max(0.0);
  person.log_rate_gain = (kMisfit / person.misfit).log().max(0.0);
  const bool is_told = &person == &people_[kTarget] && looks_.stature_m;
  person.statures = is_told ? densityOf(*looks_.stature_m, kStatureSigma_m) : anybody_statures_;
  person.statures *= person.log_tallness.exp();
  person.statures /= person.statures.sum();
}

void Gallery::takeApart(const Eigen::ArrayXXf& look) {
  look_.clear();
  ends_.clear();
  entropies_.clear();
  for (Eigen::Index part = 0; part < look.cols(); ++part) {
    double entropy = 0.0;
    for (Eigen::Index bin = 0; bin < look.rows(); ++bin) {
      const float share = look(bin, part);
      if (share <= 0.0F) continue;
      look_.push_back({static_cast<int>(bin), share});
      entropy += static_cast<double>(share * std::log(share));
    }
    ends_.push_back(look_.size());
    entropies_.push_back(entropy);
  }
}

/// KL(a part of the look at hand || a portrait's) in a light.
/// @param log_shares  of the portrait's part
double Gallery::divergence(const float* log_shares, std::size_t part, const Tint& tint) const {
  float mean = 0.0F;
  for (std::size_t n = part == 0 ? 0 : ends_[part - 1]; n < ends_[part]; ++n) {
    mean += look_[n].share * log_shares[tint.bins[look_[n].bin]];
  }
  return entropies_[part] - static_cast<double>(mean);
}

/// Of a part of the look at hand, in a light.
double Gallery::logOdds(double misfit, std::size_t part, const Tint& tint) const {
  return kLikenessOffset + kRarityShare * divergence(log_anybody_.data(), part, tint) - misfit;
}

/// Over the parts that both the look and the portrait show, in the light that fits best; leaves
/// their log odds and misfits in that light, 0 and -1 where there is none, if it fits better than
/// what is there.
/// @return  Their sum with the share of such looks.
double Gallery::likeness(const Person& person, const Portrait& portrait, double log_share) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Tint& tint : looks_.tints) {
    double sum = log_share + tint.log_prior;
    misfit_.setConstant(portrait.mean.cols(), -1.0);
    parts_.setZero(portrait.mean.cols());
    for (std::size_t part = 0, i = 0; part < ends_.size(); i = ends_[part++]) {
      if (i == ends_[part] || !portrait.knows[part]) continue;
      const auto column = static_cast<Eigen::Index>(part);
      const double misfit = misfit_[column] =
          std::max(divergence(portrait.log_shares.col(column).data(), part, tint), 0.0);
      // Only against them: things of their colours may fit as well.
      const double against =
          kMisfitShape * (misfit * person.rate_gain[column] - person.log_rate_gain[column]);
      parts_[column] = logOdds(misfit, part, tint) -
                       std::clamp(against, 0.0, -std::log(params_.misleading_share));
      sum += parts_[column];
    }
    most = std::max(most, sum);
    if (sum <= best_) continue;
    best_ = sum;
    best_misfit_.swap(misfit_);
    best_parts_.swap(parts_);
    if (&person != &people_[kTarget]) continue;
    best_like_.setZero(best_parts_.size());
    for (Eigen::Index part = 0; part < best_like_.size(); ++part) {
      if (best_misfit_[part] < 0.0) continue;
      const auto i = static_cast<std::size_t>(part);
      const double misfit = divergence(portrait.log_like.col(part).data(), i, tint);
      best_like_[part] = logOdds(std::max(misfit, 0.0), i, tint);
    }
  }
  return most;
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
  for (int h = kFirstOther; h < kHypotheses; ++h) {
    if (!isKnown(h)) evidence.light[h] = -std::numeric_limits<double>::infinity();
  }
  evidence.parts.setZero(kHypotheses, looks_.target.cols());
  evidence.misfits.setConstant(kHypotheses, looks_.target.cols(), -1.0);
  evidence.is_seen.setZero(looks_.target.cols());
  if (seen.look == nullptr || anybody_.size() == 0) return;
  if (seen.look->rows() != looks_.target.rows() || seen.look->cols() != looks_.target.cols()) {
    throw std::invalid_argument("Gallery: a look needs the target's bins and parts");
  }
  takeApart(*seen.look);
  if (look_.empty()) return;
  for (std::size_t part = 0, i = 0; part < ends_.size(); i = ends_[part++]) {
    evidence.is_seen[static_cast<Eigen::Index>(part)] = i < ends_[part] ? 1.0 : 0.0;
  }
  for (int h = kTarget; h < kHypotheses; ++h) {
    if (!isKnown(h)) continue;
    best_ = -std::numeric_limits<double>::infinity();
    // Half of the target is what was seen lately, as that comes to rest on more.
    const double lately =
        h == kTarget ? 0.5 * lately_.weight / (lately_.weight + kFirstWeight) : 0.0;
    const Person& person = people_[index(h)];
    double sum = likeness(person, person.portrait, std::log1p(-lately));
    if (lately > 0.0) {
      const double other = likeness(person, lately_, std::log(lately));
      sum = best_ + std::log1p(std::exp(-std::abs(sum - other)));
    }
    evidence.light[h] = sum - best_parts_.sum();
    evidence.parts.row(h) = best_parts_.transpose();
    evidence.misfits.row(h) = best_misfit_.transpose();
    if (h == kTarget) evidence.parts.row(kStranger) = best_like_.transpose();
  }
}

LookOdds Gallery::logOdds(const LookEvidence& look, const Eigen::ArrayXXd* known) const {
  LookOdds odds{look.light};
  if (!(look.is_seen > 0.0).any()) return odds;
  for (int h = kStranger; h < kHypotheses; ++h) {
    const double light =
        look.light[std::max<int>(h, kTarget)];  // The like is seen in the target's.
    if (!std::isfinite(light)) continue;
    Eigen::Array<double, kGarments, 1> garments = Eigen::Array<double, kGarments, 1>::Zero();
    for (Eigen::Index part = 0; part < look.parts.cols(); ++part) {
      garments[looks_.garments[static_cast<std::size_t>(part)]] +=
          look.is_seen[part] > 0.0 || known == nullptr ? look.parts(h, part) : (*known)(h, part);
    }
    const double sum = light + garments.sum();
    // Fewer looks are like somebody by chance than are unlike themselves.
    const double mislead = params_.misleading_share, alike = mislead * mislead;
    const double ratio = std::exp(std::min(sum, 100.0));
    const double bounded =
        std::log(((1.0 - mislead) * ratio + mislead) / (1.0 - alike + alike * ratio));
    if (h != kStranger) odds.all[h] = bounded;
    if (h > kTarget) continue;
    constexpr double kNothing = 1e-6;  // Nearer to 0 the share is the slope there.
    odds.garments.col(h == kTarget ? kOwn : kLike) =
        garments * (std::abs(sum) > kNothing ? bounded / sum : 1.0 - mislead - alike);
  }
  return odds;
}

double Gallery::logAlike(const Garments& garments) const {
  const double share = params_.misleading_share;
  const auto like = garments.col(kLike);
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
