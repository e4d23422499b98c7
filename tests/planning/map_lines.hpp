// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Maps drawn in the source.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <string>
#include <vector>

namespace heel::test {

/// A map from lines of text, the first at the top: `#` is a wall, anything else is free. The corner
/// at the bottom left is at the origin.
inline OccupancyGrid drawnMap(const std::vector<std::string>& lines, double cell_size_m) {
  const int width = static_cast<int>(lines.front().size()), height = static_cast<int>(lines.size());
  OccupancyGrid map({0.0, 0.0}, cell_size_m, width, height);
  for (int y = 0; y < height; ++y) {
    const std::string& line = lines[static_cast<std::size_t>(height - 1 - y)];
    for (int x = 0; x < width; ++x) {
      if (line[static_cast<std::size_t>(x)] == '#') map.at(GridCell{x, y}) = Occupancy::kOccupied;
    }
  }
  return map;
}

}  // namespace heel::test
