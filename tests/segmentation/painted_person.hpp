// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Colours of a made-up person and room, for tests of appearance.
#pragma once

#include <heel/segmentation/appearance_model.hpp>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace heel::test {

inline std::uint8_t toChannel(double value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
}

/// `count` pixels of a colour with a camera's noise.
inline ColorHistogram paint(Bgr color, int count, double noise = 6.0, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, noise);
  ColorHistogram colors;
  for (int i = 0; i < count; ++i) {
    const double b = color.b + normal(generator);
    const double g = color.g + normal(generator);
    const double r = color.r + normal(generator);
    colors.add(toChannel(b), toChannel(g), toChannel(r));
  }
  return colors;
}

inline constexpr Bgr kRed{40, 30, 180};
inline constexpr Bgr kSkin{130, 160, 210};
inline constexpr Bgr kWhite{235, 240, 238};
inline constexpr Bgr kFloor{150, 165, 170};
inline constexpr Bgr kNavy{50, 22, 14};
inline constexpr Bgr kBlack{12, 12, 12};

/// White desks, a beige floor, black monitors.
inline ColorHistogram paintRoom() {
  ColorHistogram room = paint(kWhite, 4000, 6.0, 2);
  room.merge(paint(kFloor, 8000, 8.0, 3));
  room.merge(paint(kBlack, 2000, 4.0, 4));
  return room;
}

/// A person with a red jumper and skin above it.
inline std::vector<ColorHistogram> paintPerson() { return {paint(kRed, 3000), paint(kSkin, 900)}; }

inline bool sameColors(const ColorHistogram& a, const ColorHistogram& b) {
  bool same = a.total() == b.total();
  a.forEach([&](Bgr c, std::uint64_t count) { same = same && b(c.b, c.g, c.r) == count; });
  return same;
}

}  // namespace heel::test
