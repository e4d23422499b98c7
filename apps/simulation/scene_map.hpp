// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The map that a scene's robot is given.
#pragma once

#include <heel/apps/simulation/scene.hpp>
#include <heel/mapping/wall_map.hpp>

namespace heel {

/// The scene's walls, with their doorways, and the furniture that is in the robot's map; the floor
/// within floorBounds() is known to be free where none of these is. World frame.
WallMap wallMapOf(const Scene& scene, double cell_size_m = 0.05);

}  // namespace heel
