// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Values that are spread over a face.
#pragma once

#include <heel/apps/simulation/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace heel {

/// Values at the centres of a grid over a face. Places are `a`, `b` in [0, 1] along its edges.
template <typename T>
struct FaceGrid {
  int columns = 0;
  int rows = 0;
  std::vector<T> values;

  /// Interpolated between the cells' centres.
  T at(float a, float b) const;
  /// Of the cell that the place is in.
  const T& nearest(float a, float b) const;
};

/// Cells of about `cell_m`, all of one value.
template <typename T>
FaceGrid<T> gridOver(const Face& face, float cell_m, const T& value) {
  const auto cells = [cell_m](float length_m) {
    return std::clamp(static_cast<int>(std::ceil(length_m / cell_m)), 1, 400);
  };
  FaceGrid<T> grid;
  grid.columns = cells(face.edge_u.norm());
  grid.rows = cells(face.edge_v.norm());
  grid.values.assign(static_cast<std::size_t>(grid.columns * grid.rows), value);
  return grid;
}

/// Calls `visit(a, b, value)` with the middle of each cell.
template <typename T, typename Visit>
void forEachCell(FaceGrid<T>& grid, const Visit& visit) {
  auto value = grid.values.begin();
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      visit((static_cast<float>(i) + 0.5F) / static_cast<float>(grid.columns),
            (static_cast<float>(j) + 0.5F) / static_cast<float>(grid.rows), *value++);
    }
  }
}

template <typename T>
T FaceGrid<T>::at(float a, float b) const {
  const float x = std::min(std::max(a * static_cast<float>(columns) - 0.5F, 0.0F),
                           static_cast<float>(columns - 1));
  const float y =
      std::min(std::max(b * static_cast<float>(rows) - 0.5F, 0.0F), static_cast<float>(rows - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, columns - 1), y1 = std::min(y0 + 1, rows - 1);
  const float wx = x - static_cast<float>(x0), wy = y - static_cast<float>(y0);
  const auto value = [this](int i, int j) -> const T& {
    return values[static_cast<std::size_t>(j * columns + i)];
  };
  const T upper = value(x0, y0) * (1.0F - wx) + value(x1, y0) * wx;
  const T lower = value(x0, y1) * (1.0F - wx) + value(x1, y1) * wx;
  return upper * (1.0F - wy) + lower * wy;
}

template <typename T>
const T& FaceGrid<T>::nearest(float a, float b) const {
  const int column = std::clamp(static_cast<int>(a * static_cast<float>(columns)), 0, columns - 1);
  const int row = std::clamp(static_cast<int>(b * static_cast<float>(rows)), 0, rows - 1);
  return values[static_cast<std::size_t>(row * columns + column)];
}

}  // namespace heel
