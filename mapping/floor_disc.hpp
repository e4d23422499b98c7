// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A round part of the floor.
#pragma once

#include <Eigen/Core>

namespace heel {

struct FloorDisc {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double radius_m = 0.0;
};

}  // namespace heel
