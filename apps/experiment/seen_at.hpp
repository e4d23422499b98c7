// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the perception makes of one place on the floor.
#pragma once

#include <heel/apps/follower/perception.hpp>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace heel {

/// Whether a place is known and no further than that.
bool isNear(const Eigen::Vector2d& a, const std::optional<Eigen::Vector2d>& b, double distance_m);

/// The probability that the confirmed track nearest to a place is the target; 0 without one within
/// the distance.
double targetProbabilityAt(const Eigen::Vector2d& place, const Perception& perception,
                           double distance_m);

/// The score of the blob nearest to a place; 0 without one within the distance.
double blobScoreAt(const Eigen::Vector2d& place, const std::vector<Observation>& observations,
                   double distance_m);

}  // namespace heel
