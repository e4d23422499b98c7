// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far each cell of a grid is from the nearest occupied one.
#pragma once

#include <cstdint>
#include <vector>

namespace heel {

/// Exact Euclidean distances between the middles of cells, in linear time (Meijster, Roerdink and
/// Hesselink, "A general algorithm for computing distance transforms in linear time", 2000).
///
/// In place of cv::distanceTransform, which allocates at every call.
class DistanceTransform {
 public:
  /// @param occupied     Row by row; not 0 where a cell is occupied.
  /// @param distance_m   Out: as large as `occupied`; infinite everywhere if no cell is occupied.
  /// @throws std::invalid_argument  unless there are width x height cells of a positive size.
  void compute(const std::vector<std::uint8_t>& occupied, int width, int height, double cell_size_m,
               std::vector<float>& distance_m);

 private:
  std::vector<int> along_column_;  // cells to the nearest occupied one in the same column
  std::vector<int> site_, from_;   // the row's nearest columns, and from which cell on they are
};

}  // namespace heel
