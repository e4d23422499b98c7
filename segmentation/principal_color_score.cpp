// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/color_clusters.hpp"
#include "segmentation/color_score.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

struct Hsv {
  double hue;  // in [0, 1): a turn; 0 for greys
  double saturation;
  double value;
};

Hsv toHsv(std::uint8_t b8, std::uint8_t g8, std::uint8_t r8) {
  const double b = b8 / 255.0;
  const double g = g8 / 255.0;
  const double r = r8 / 255.0;
  const double value = std::max({b, g, r});
  const double range = value - std::min({b, g, r});
  if (range <= 0.0) return {0.0, 0.0, value};
  double sixths = 0.0;
  if (value == r) {
    sixths = (g - b) / range;
  } else if (value == g) {
    sixths = 2.0 + (b - r) / range;
  } else {
    sixths = 4.0 + (r - g) / range;
  }
  if (sixths < 0.0) sixths += 6.0;
  return {sixths / 6.0, range / value, value};
}

std::size_t binOf(double share, std::size_t bins) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(bins)), bins - 1);
}

/// The paper's A = <D_H, D_V>.
struct PrincipalColor {
  std::vector<double> hue_shares;
  std::vector<double> value_shares;

  double operator()(const Hsv& c) const {
    return c.saturation * hue_shares[binOf(c.hue, hue_shares.size())] +
           (1.0 - c.saturation) * value_shares[binOf(c.value, value_shares.size())];
  }
};

PrincipalColor makePrincipalColor(const ColorHistogram& points,
                                  const PrincipalColorParams& params) {
  PrincipalColor color{std::vector<double>(static_cast<std::size_t>(params.hue_bins), 0.0),
                       std::vector<double>(static_cast<std::size_t>(params.value_bins), 0.0)};
  const auto total = static_cast<double>(points.total());
  points.forEach([&](Bgr c, std::uint64_t count) {
    const Hsv hsv = toHsv(c.b, c.g, c.r);
    const double share = static_cast<double>(count) / total;
    color.hue_shares[binOf(hsv.hue, color.hue_shares.size())] += share;
    color.value_shares[binOf(hsv.value, color.value_shares.size())] += share;
  });
  return color;
}

}  // namespace

ColorScore principalColorScore(const ColorHistogram& person, const PrincipalColorParams& params) {
  if (params.count < 0 || params.max_count < 1) {
    throw std::invalid_argument("the number of principal colours must not be negative");
  }
  if (params.hue_bins < 1 || params.value_bins < 1) {
    throw std::invalid_argument("hue and value need at least one bin");
  }
  const auto parts = params.count == 0
                         ? clusterColorsFromData(person, params.max_count, params.min_spread_drop)
                         : clusterColors(person, params.count);
  auto colors = std::make_shared<std::vector<PrincipalColor>>();
  for (const ColorHistogram& cluster : parts.clusters) {
    colors->push_back(makePrincipalColor(cluster, params));
  }
  return [colors](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    const Hsv hsv = toHsv(b, g, r);
    double best = 0.0;
    for (const PrincipalColor& color : *colors) best = std::max(best, color(hsv));
    return best;
  };
}

}  // namespace heel
