// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How alike a body and the target's are, in all that was learned.
#pragma once

#include "segmentation/body_appearance.hpp"
#include "segmentation/color_profile.hpp"
#include "segmentation/stature.hpp"

#include <opencv2/core/matx.hpp>

#include <optional>
#include <vector>

namespace heel {

struct BodyMatchParams {
  BodyAppearanceParams body;  ///< Its prior_points count for a band's colours here too.
  /// The affinity of a band of which nothing is seen.
  double prior_affinity = 0.8;
  /// The light may be so much brighter or darker than where the person was learned, as a natural
  /// logarithm: all bands of a body are compared as they would look in that light.
  double max_light_change = 1.2;
  /// An affinity counts to this power. It brings the scale of bodyAppearance(): 0.41 parted people
  /// best on simulated wardrobes.
  double sharpness = 2.0;
  double stature_sigma_m = 0.05;  ///< Of a frame's stature, besides what it scattered in phase 1.
  double least_stature = 0.15;    ///< A single frame's stature may be wild; it counts so much.
  /// Who is not seen up to the head counts no more than this where the stature is known: enough to
  /// be followed on, not to be taken for the target.
  double unknown_stature = 0.4;
};

/// Compares bodies with a model: each band's colours by their distribution, and the stature. The
/// least of them counts, for one garment that is another's is enough to tell people apart, however
/// alike all others are.
///
/// Holds the memory that it works in; allocates nothing once warm.
class BodyMatcher {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit BodyMatcher(const AppearanceModel& model, const BodyMatchParams& params = {});

  /// In (0, 1], 1 for the same: the least, over the bands, of affinity^sharpness (see ColorSample)
  /// and, of e^(-d^2 / 2 sigma^2) where both statures are known and differ by d.
  double match(const BodyView& view, const WorldBlob& blob);

  /// The same over the points of a cloud in the base frame.
  double match(const ColorCloud& cloud, const WorldBlob& blob);

 private:
  struct Band {
    BodyBand body;
    ColorProfile profile;
    std::vector<cv::Vec3b> pixels;  // of the body at hand
  };

  float lightChange() const;
  template <typename ForEachPixel>
  double matchPixels(const ForEachPixel& for_each);

  BodyMatchParams params_;
  std::vector<Band> bands_;
  std::optional<Stature> stature_;
  ColorSample colors_;
  StatureSample heights_;
};

}  // namespace heel
