// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the tracker is told: a possible person's place on the floor.
#pragma once

#include <Eigen/Core>

namespace heel {

/// A world blob as the tracker sees it.
struct Observation {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< In a frame fixed to the floor.
  double score = 0.0;  ///< Size of the blob; of several that compete the higher is preferred.
  /// How well its colours fit the target's model, in (0, 1]; 0.5 says nothing either way.
  double appearance = 0.5;
  bool can_start = true;  ///< Enough of a person to start a track, not only to go on with one.
};

}  // namespace heel
