// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the tracker is told: a possible person's place on the floor, and what they look like.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace heel {

/// A world blob as the tracker sees it.
struct Observation {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< In a frame fixed to the floor.
  double score = 0.0;     ///< Size of the blob; of several that compete the higher is preferred.
  bool can_start = true;  ///< Enough of a person to start a track, not only to go on with one.
  /// Of the place, beside TrackerParams::position_sigma_m: stereo sees depth badly far away.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  /// Row: a bin of what is described (colour, say); column: a part of the body. A column sums to 1,
  /// or to 0 where the part is not seen. Null: nothing is known of its looks. Must outlive the
  /// step.
  const Eigen::ArrayXXf* look = nullptr;
  std::optional<double> stature_m = {};  ///< If it is seen up to the head.
  /// What its outline, depth and the laser say: logarithm of the odds that it is a person, not a
  /// thing.
  double log_person = 0.0;
};

}  // namespace heel
