// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

void check(const AppearanceParams& params) {
  if (params.bands.empty()) throw std::invalid_argument("an appearance needs at least one band");
  for (const BodyBand& band : params.bands) {
    if (!(std::isfinite(band.min_height_m) && std::isfinite(band.max_height_m) &&
          band.min_height_m < band.max_height_m)) {
      throw std::invalid_argument("the heights of band '" + band.name + "' are not in order");
    }
  }
  if (!(params.max_error_share >= 0.0)) {
    throw std::invalid_argument("the greatest share of errors must not be negative");
  }
}

ColorScore plainScore(const AppearanceParams& params, const ColorHistogram& person,
                      const ColorHistogram& room) {
  switch (params.model) {
    case ColorModel::kPrincipalColors:
      return principalColorScore(person, params.principal_colors);
    case ColorModel::kColorRatio:
      return colorRatioScore(person, room, params.color_ratio);
    case ColorModel::kHueSaturation:
      return hueSaturationScore(person, params.hue_saturation);
  }
  throw std::invalid_argument("there is no such colour model");
}

ColorScore makeScore(const AppearanceParams& params, const ColorHistogram& person,
                     const ColorHistogram& room) {
  ColorScore plain = plainScore(params, person, room);
  if (!params.suppress_background) return plain;
  ColorRatioParams room_only = params.color_ratio;
  room_only.other_weight = 1e-3;  // Next to nothing: only the room's colours are discounted.
  return [plain = std::move(plain), share = colorRatioScore(person, room, room_only)](
             std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return plain(b, g, r) * share(b, g, r);
  };
}

/// Tabulates the band's scores, stretched so that the person's best colour has 255: the paper's
/// scores are small, for they are shares of many bins.
void tabulate(const ColorScore& score, AppearanceBand& band) {
  double best = 0.0;
  band.person.forEach([&](Bgr c, std::uint64_t) { best = std::max(best, score(c.b, c.g, c.r)); });
  band.score_per_level = best / 255.0;
  band.table = ColorTable([&](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const double level = std::round(score(b, g, r) / band.score_per_level);
    return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0));
  });
}

double errorShare(const AppearanceBand& band) {
  return band.errors().false_negative_share + band.errors().false_positive_share;
}

/// Each stripe has the colours of the band that holds its middle.
BodyDescription portraitOf(const std::vector<AppearanceBand>& bands) {
  BodyDescription portrait;
  portrait.colors.setZero(BodyDescriber::kBins, BodyDescriber::kStripes);
  for (const AppearanceBand& band : bands) {
    if (band.person.empty()) continue;
    const Eigen::ArrayXf bins = BodyDescriber::binsOf(band.person);
    for (int stripe = 0; stripe < BodyDescriber::kStripes; ++stripe) {
      if (band.body.contains(BodyDescriber::middleOf_m(stripe))) portrait.colors.col(stripe) = bins;
    }
  }
  return portrait;
}

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100.0 * share);
  return text;
}

}  // namespace

std::vector<BodyBand> upperBody() { return {{"upper body", 1.0, 2.2}}; }

std::vector<BodyBand> torsoAndHead() { return {{"torso", 1.0, 1.45}, {"head", 1.45, 2.2}}; }

std::vector<BodyBand> wholeBody() {
  return {{"torso", 1.0, 1.45}, {"head", 1.45, 2.2}, {"legs", 0.25, 0.9}};
}

AppearanceModel::AppearanceModel(AppearanceParams params, std::vector<ColorHistogram> person,
                                 ColorHistogram room, std::optional<Stature> stature,
                                 BodyDescription portrait)
    : params_(std::move(params)),
      room_(std::move(room)),
      stature_(stature),
      portrait_(std::move(portrait)) {
  check(params_);
  if (person.size() != params_.bands.size()) {
    throw std::invalid_argument("each band of an appearance needs its counts of the person");
  }
  if (room_.empty()) throw std::invalid_argument("there are no colours of the room");
  bool has_points = false;
  for (std::size_t i = 0; i < person.size(); ++i) {
    AppearanceBand band;
    band.body = params_.bands[i];
    band.person = std::move(person[i]);
    bands_.push_back(std::move(band));
    if (bands_[i].person.empty()) continue;
    has_points = true;
    tabulate(makeScore(params_, bands_[i].person, room_), bands_[i]);
    bands_[i].error_curve = countColorErrors(bands_[i].table, bands_[i].person, room_);
    setThreshold(i, chooseThreshold(bands_[i].error_curve, params_.threshold));
  }
  if (!has_points) throw std::invalid_argument("there are no colours of the person");
  if (portrait_.colors.size() == 0) portrait_ = portraitOf(bands_);
}

ColorTable AppearanceModel::filterTable() const {
  return ColorTable([this](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const bool passes = std::any_of(bands_.begin(), bands_.end(), [&](const AppearanceBand& band) {
      return band.table.passes(b, g, r);
    });
    return static_cast<std::uint8_t>(passes ? 255 : 0);
  });
}

void AppearanceModel::setThreshold(std::size_t band, std::uint8_t threshold) {
  ColorTable& table = bands_.at(band).table;
  if (!table.empty()) table = table.withThreshold(threshold);
}

Separability AppearanceModel::separability() const {
  Separability result;
  const AppearanceBand* best = nullptr;
  for (const AppearanceBand& band : bands_) {
    if (band.person.total() < params_.min_points || band.table.empty()) continue;
    if (best == nullptr || errorShare(band) < errorShare(*best)) best = &band;
  }
  if (best == nullptr) {
    result.doubt = AppearanceDoubt::kTooFewPoints;
    result.advice =
        "The model rests on too few points of the person: let the person stay in view longer, or "
        "come nearer.";
    return result;
  }
  result.error_share = errorShare(*best);
  if (result.error_share > params_.max_error_share) {
    result.doubt = AppearanceDoubt::kLikeTheRoom;
    result.advice = "The person's colours are the room's: even the " + best->body.name +
                    " keeps only " + percent(1.0 - best->errors().false_negative_share) +
                    " of the person while " + percent(best->errors().false_positive_share) +
                    " of the room passes. Let the person wear another colour, learn the legs too, "
                    "or improve the light.";
  }
  return result;
}

}  // namespace heel
