// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_match.hpp"

#include "segmentation/body_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kManyPixels = 200.0;  // More of a band say no more about the light.

}  // namespace

BodyMatcher::BodyMatcher(const AppearanceModel& model, const BodyMatchParams& params)
    : params_(params), stature_(model.stature()) {
  if (!(params.prior_affinity >= 0.0 && params.prior_affinity <= 1.0)) {
    throw std::invalid_argument("BodyMatchParams: prior_affinity must be in [0, 1]");
  }
  if (!(params.sharpness > 0.0 && params.stature_sigma_m > 0.0)) {
    throw std::invalid_argument("BodyMatchParams: sharpness and stature_sigma_m must be positive");
  }
  if (!(params.max_light_change >= 0.0)) {
    throw std::invalid_argument("BodyMatchParams: max_light_change must not be negative");
  }
  for (const AppearanceBand& band : model.bands()) {
    if (!band.person.empty()) bands_.push_back({band.body, ColorProfile(band.person), {}});
  }
}

/// What the body at hand lacks of the light in which the model was learned, as a natural logarithm:
/// the mean over the bands, as far as they are seen.
float BodyMatcher::lightChange() const {
  double sum = 0.0, weights = 0.0;
  for (const Band& band : bands_) {
    if (band.pixels.empty()) continue;
    double light = 0.0;
    for (const cv::Vec3b& bgr : band.pixels) {
      light += static_cast<double>(ColorProfile::lightOf(bgr[0], bgr[1], bgr[2]));
    }
    const auto seen = static_cast<double>(band.pixels.size());
    const double weight = std::min(seen, kManyPixels);
    sum += weight * (band.profile.light() - light / seen);
    weights += weight;
  }
  if (weights <= 0.0) return 0.0F;
  return static_cast<float>(
      std::clamp(sum / weights, -params_.max_light_change, params_.max_light_change));
}

/// @param for_each  Called as for_each(band, visit(bgr, height_m, row)).
template <typename ForEachPixel>
double BodyMatcher::matchPixels(const ForEachPixel& for_each) {
  const double prior = params_.body.prior_points;
  heights_.clear();
  double least = 1.0;
  for (Band& band : bands_) {
    band.pixels.clear();
    for_each(band.body, [&](const cv::Vec3b& bgr, float height_m, int row) {
      band.pixels.push_back(bgr);
      if (height_m > 0.0F) heights_.add(static_cast<double>(height_m), row);
    });
  }
  const float lighter = lightChange();
  for (const Band& band : bands_) {
    colors_.clear();
    for (const cv::Vec3b& bgr : band.pixels) colors_.add(bgr[0], bgr[1], bgr[2], lighter);
    const double seen = colors_.total();
    const double affinity =
        seen + prior > 0.0
            ? (seen * colors_.affinity(band.profile) + prior * params_.prior_affinity) /
                  (seen + prior)
            : params_.prior_affinity;
    least = std::min(least, std::pow(affinity, params_.sharpness));
  }
  const std::optional<double> height_m = heights_.height_m();
  if (stature_ && !height_m) least = std::min(least, params_.unknown_stature);
  if (stature_ && height_m) {
    const double apart =
        (*height_m - stature_->height_m) / std::hypot(params_.stature_sigma_m, stature_->spread_m);
    least = std::min(least, std::max(std::exp(-0.5 * apart * apart), params_.least_stature));
  }
  return std::max(least, 1e-6);
}

double BodyMatcher::match(const BodyView& view, const WorldBlob& blob) {
  const BodyPixels pixels(view, blob, params_.body);
  return matchPixels([&](const BodyBand& band, const auto& visit) { pixels.forEach(band, visit); });
}

double BodyMatcher::match(const ColorCloud& cloud, const WorldBlob& blob) {
  return matchPixels([&](const BodyBand& band, const auto& visit) {
    for (const auto& p : cloud) {
      if (isInCylinder(p.getVector3fMap(), blob.position_m, band, params_.body.radius_m)) {
        visit(cv::Vec3b(p.b, p.g, p.r), p.z, -1);
      }
    }
  });
}

}  // namespace heel
