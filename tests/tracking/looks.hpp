// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Made-up looks: a few colours, an upper and a lower part.
#pragma once

#include <heel/tracking/gallery.hpp>

#include <Eigen/Core>

namespace heel::test {

inline constexpr int kColors = 6;

/// One colour above, another below; `share` of each part has it, the rest is spread over the
/// others.
inline Eigen::ArrayXXf clothes(int upper, int lower, float share = 1.0F, int colors = kColors) {
  Eigen::ArrayXXf look =
      Eigen::ArrayXXf::Constant(colors, 2, (1.0F - share) / static_cast<float>(colors - 1));
  look(upper, 0) = share;
  look(lower, 1) = share;
  return look;
}

/// Of somebody in a room where all colours are as usual.
inline TargetLooks looksOf(const Eigen::ArrayXXf& target) {
  TargetLooks looks;
  looks.target = target;
  looks.room = looks.anybody =
      Eigen::ArrayXf::Constant(target.rows(), 1.0F / static_cast<float>(target.rows()));
  return looks;
}

inline Observation seen(double x, double y, const Eigen::ArrayXXf* look = nullptr,
                        double score = 10.0) {
  Observation seen;
  seen.position_m = {x, y};
  seen.score = score;
  seen.look = look;
  return seen;
}

}  // namespace heel::test
