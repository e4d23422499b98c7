// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The free cells around a point.
#pragma once

#include <heel/planning/grid_wave.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// Free cells of the wave whose place is within `within_m` of the
/// point, the nearest first.
void freeCellsNear(const ClearanceMap& map, const GridWave& wave, const Eigen::Vector2d& point,
                   double within_m, std::vector<int>& cells);

}  // namespace heel
