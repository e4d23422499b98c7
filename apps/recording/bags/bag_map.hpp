// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Between the maps of messages and ours.
#pragma once

#include <heel/apps/bag/messages.hpp>
#include <heel/mapping/occupancy_grid.hpp>

namespace heel {

/// 0 is free, 100 occupied, -1 unknown. The header and the time of loading are left as they are.
OccupancyGridMsg toMessage(const OccupancyGrid& map);

/// As map_server makes maps: from 65 on occupied, up to 19 free, else unknown.
/// @throws std::runtime_error  one sentence, if the sizes do not fit, or the map is turned.
OccupancyGrid toGrid(const OccupancyGridMsg& message);

}  // namespace heel
