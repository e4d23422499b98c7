// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Finds the narrow places of a map that join one room to another.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// Which narrow places of a map are doorways.
struct DoorwayParams {
  double max_width_m = 1.1;  ///< Wider passages are no doorways.
  /// A doorway is no deeper than this, from its middle to where the way gets wider.
  double depth_m = 0.35;
};

/// A gap between two rooms.
struct DoorwayOnMap {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();    ///< [m, world]
  Eigen::Vector2d through = Eigen::Vector2d::UnitX();  ///< Unit vector through it, either way.
  double width_m = 0.0;                                ///< Of the free floor between its sides.

  /// Along `through` and across it, from the centre.
  Eigen::Vector2d local(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d off = point - center;
    return {off.dot(through), through.x() * off.y() - through.y() * off.x()};
  }
};

/// How far inside a doorway's passage a point is: 1 in its middle line and plane, 0 outside.
/// Whoever goes through is as wide as the doorway; so far before and behind it, a robot's edge is
/// in there.
double inPassage(const DoorwayOnMap& doorway, const Eigen::Vector2d& point, double depth_m,
                 double radius_m);

/// Whether it is in any of them.
bool isInPassage(const std::vector<DoorwayOnMap>& doorways, const Eigen::Vector2d& point,
                 double depth_m, double radius_m);

/// The doorways of a map, the narrowest first. A doorway is a place whose free floor is narrow
/// across for a short stretch, opens to a room on at least one side, and whose two sides are joined
/// by no short way round it, so that a gap between a table and a wall is none. What is unknown
/// counts as taken. Widths are good to about two cells.
/// @throws std::invalid_argument  for an empty grid or parameters out of order.
std::vector<DoorwayOnMap> findDoorways(const OccupancyGrid& map, const DoorwayParams& params = {});

}  // namespace heel
