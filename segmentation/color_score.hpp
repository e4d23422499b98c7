// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What an appearance model says about a colour, and the models that Heel offers.
#pragma once

#include <heel/segmentation/color_histogram.hpp>

#include <cstdint>
#include <functional>

namespace heel {

/// How much a colour looks like the target's: in [0, 1], more is more alike.
///
/// This is all that the rest of Heel knows of a colour model: whatever makes one of these from what
/// phase 1 counted can be tabulated, given a threshold, and used as a filter.
using ColorScore = std::function<double(std::uint8_t b, std::uint8_t g, std::uint8_t r)>;

/// The paper's model (sections 2 and 3.1), for one or several principal colours.
struct PrincipalColorParams {
  /// k, the number of colours; 1 is the paper's setting, 0 chooses it from the data.
  int count = 1;
  int max_count = 4;             ///< Greatest k that is chosen from the data.
  double min_spread_drop = 0.4;  ///< One more colour must take away this share of the spread.
  int hue_bins = 36;             ///< Bins of hue over the full circle.
  int value_bins = 32;           ///< Bins of value over [0, 1].
};

/// The greatest, over the principal colours, of s D_H(h) + (1 - s) D_V(v).
///
/// D_H and D_V are the shares of that colour's points by hue and by value. The logical disjunction
/// of the paper (any colour's score is above delta) is the threshold on the greatest score.
/// @throws std::invalid_argument  if a parameter is out of range or `person` is empty.
ColorScore principalColorScore(const ColorHistogram& person,
                               const PrincipalColorParams& params = {});

/// One histogram of hue and saturation together.
struct HueSaturationParams {
  int hue_bins = 36;        ///< Bins of hue over the full circle.
  int saturation_bins = 8;  ///< Bins of saturation over [0, 1].
};

/// The person's share of the colour's bin, smoothed by one bin each way. Blind to value, so light
/// and shade are one; so are grey, black and white, and of what is dark, hue and saturation are
/// mostly noise.
/// @throws std::invalid_argument  if a parameter is out of range or `person` is empty.
ColorScore hueSaturationScore(const ColorHistogram& person, const HueSaturationParams& params = {});

/// How colours are smoothed and compared with the room's. Units are at each field.
struct ColorRatioParams {
  /// Added to each channel before its logarithm is taken: darker colours than this count as alike.
  double dark_offset = 12.0;
  double chroma_limit = 1.5;    ///< Log-chromaticities are clipped at plus and minus this.
  int chroma_bins = 36;         ///< Bins of each of the two chromaticities, over both signs.
  int brightness_bins = 32;     ///< Bins of brightness, over the logarithms of 0 to 255.
  double smoothing_bins = 1.0;  ///< Standard deviation of the Gaussian on the histograms.
  /// Weight of "anything else", a stranger or thing of any colour, where the room has 1. It keeps
  /// out colours that neither the person nor the room showed.
  double other_weight = 1.0;
};

/// How likely a colour is the person's, not the room's nor anything else's: p / (p + q + u).
///
/// p and q are the person's and the room's smoothed shares in the joint histogram of
/// log((r + o) / (g + o)), log((b + o) / (g + o)) and log((r + g + b) / 3 + o), o the dark offset;
/// u is the other weight, shared by all bins alike. So a colour that the empty room has as well
/// counts little, however much the person wears of it, and navy is told from black.
/// @throws std::invalid_argument  if a parameter is out of range, or a histogram is empty.
ColorScore colorRatioScore(const ColorHistogram& person, const ColorHistogram& room,
                           const ColorRatioParams& params = {});

/// Whether a channel of colours, which has 256 values, can be divided into so many bins.
constexpr bool isBinCount(int bins) { return bins >= 1 && bins <= 256; }

}  // namespace heel
