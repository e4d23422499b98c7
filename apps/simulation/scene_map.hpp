// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The maps of a scene: the one that its robot is given, and what the robot would have made of it.
#pragma once

#include <heel/apps/simulation/scene.hpp>
#include <heel/mapping/occupancy_grid.hpp>
#include <heel/mapping/wall_map.hpp>

namespace heel {

/// The scene's walls, with their doorways, and the furniture that is in the robot's map; the floor
/// within floorBounds() is known to be free where none of these is. World frame.
WallMap wallMapOf(const Scene& scene, double cell_size_m = 0.05);

/// Which slice of the world a map shows.
struct SceneGridParams {
  double cell_size_m = 0.05;  ///< Edge of a cell.
  double low_m = 0.0;  ///< Furniture that reaches into the heights from here on is in the map.
  /// Furniture that begins higher than this is not in the map; for one height of a laser, the same
  /// as low_m.
  double high_m = 1.9;
  double margin_m = 0.2;  ///< Free margin around the outer walls.
};

/// Walls and the furniture that is in the robot's map; a cell is occupied if its middle is in one
/// of them. Free is only what the robot can reach from its start, the rest is unknown.
/// @throws std::invalid_argument  if the cell size is not positive.
OccupancyGrid sceneGrid(const Scene& scene, const SceneGridParams& params = {});

/// What the robot's own laser sees: a map for localization.
OccupancyGrid laserGrid(const Scene& scene, double cell_size_m = 0.05);

}  // namespace heel
