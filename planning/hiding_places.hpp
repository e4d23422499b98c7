// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where somebody may stand whom a laser scan can't show.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/planning/surroundings.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// Where a scan's range jumps by more than a body is wide further than a wall would go on, and what
/// stands before the jump is wide enough, somebody may stand behind the edge. Their place is the
/// nearest to the edge that has room for a body (5 cm less), and touches the beam that passes the
/// edge: there they step out first.
/// @param scanner    Where the scan was measured [m, world].
/// @param clearance  Of what is known.
/// @param body_m     Radius of a body; above 0.
/// @param places     The middles of such bodies [m, world]; what it held is gone.
void findHidingPlaces(const LaserScan& scan, const FloorPose& scanner, Clearance clearance,
                      double body_m, std::vector<Eigen::Vector2d>& places);

}  // namespace heel
