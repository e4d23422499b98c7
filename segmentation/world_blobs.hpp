// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Connected components of the plan view: the paper's world blobs (section 3.2).
#pragma once

#include <Eigen/Core>

namespace heel {

/// One connected component of the plan view: perhaps a person.
struct WorldBlob {
  Eigen::Vector2d position_m =
      Eigen::Vector2d::Zero();  ///< On the floor, in the plan view's frame.
  double score = 0.0;  ///< Sum of the cells' weights (greatest heights) [m], as in the paper.
  double max_height_m = 0.0;  ///< Greatest height in the blob.
  int cells = 0;              ///< How many cells it covers.
  int points = 0;             ///< How many points fell on it.
  double appearance = 0.0;    ///< Mean colour score of its points in [0, 1]; 0 without a model.
};

}  // namespace heel
