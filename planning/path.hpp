// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A path on the floor as a line of way points.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace heel {

using FloorPath = std::vector<Eigen::Vector2d>;

/// Length of the line through these points [m].
double pathLength(const FloorPath& path);

/// The same line with its way points and, evenly between each two of them, so many more that no
/// step is longer than `step_m`.
/// @throws std::invalid_argument  unless the step is positive.
void resample(const FloorPath& path, double step_m, FloorPath& out);
FloorPath resample(const FloorPath& path, double step_m);

}  // namespace heel
