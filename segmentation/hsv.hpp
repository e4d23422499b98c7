// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Hue, saturation and value of a colour, for the models that are made of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace heel {

/// Each in [0, 1].
struct Hsv {
  double hue;  // in [0, 1): a turn; 0 for greys
  double saturation;
  double value;
};

inline Hsv toHsv(std::uint8_t b8, std::uint8_t g8, std::uint8_t r8) {
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

/// The bin, of `bins` over [0, 1], that holds a share.
inline std::size_t hsvBin(double share, std::size_t bins) {
  return std::min(static_cast<std::size_t>(share * static_cast<double>(bins)), bins - 1);
}

}  // namespace heel
