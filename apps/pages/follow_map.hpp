// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A run of following on the map, as the paper's Figure 4 shows it.
#pragma once

#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pages/run_moments.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <string>

namespace heel {

/// The walls and the ways of the robot and the person.
MapFrame followFrame(const FollowLog& log);

/// Walls, the robot's path, the person's path, both joined at even times, where the target was
/// lost and found, and the marks that the page's script moves to one moment: SVG.
std::string followMap(const FollowLog& log, const MapFrame& frame);

/// What the marks of followMap() mean: list items.
std::string followMapLegend(const FollowLog& log);

/// Where followMap()'s marks are at each moment.
void addFollowMarks(const FollowLog& log, const MapFrame& frame, RunMoments& moments);

}  // namespace heel
