// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/free_cells.hpp>

#include <algorithm>

namespace heel {

void freeCellsNear(const ClearanceMap& map, const GridWave& wave, const Eigen::Vector2d& point,
                   double within_m, std::vector<int>& cells) {
  cells.clear();
  if (!map.isInside(point)) return;
  const int middle = wave.cellOf(point), width = wave.width();
  const int reach = static_cast<int>(std::min(within_m / wave.cell_size_m() + 1.0, 1e6));
  const int mx = middle % width, my = middle / width;
  const auto distance = [&](int cell) { return (wave.placeOf(cell) - point).squaredNorm(); };
  for (int y = std::max(0, my - reach); y <= std::min(wave.height() - 1, my + reach); ++y) {
    for (int x = std::max(0, mx - reach); x <= std::min(width - 1, mx + reach); ++x) {
      const int cell = y * width + x;
      if (wave.isFree(cell) && distance(cell) <= within_m * within_m) cells.push_back(cell);
    }
  }
  std::sort(cells.begin(), cells.end(), [&](int a, int b) {
    const double da = distance(a), db = distance(b);
    return da < db || (da == db && a < b);
  });
}

}  // namespace heel
