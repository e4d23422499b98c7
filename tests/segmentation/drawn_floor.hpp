// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Clouds drawn as text, seen from above.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace heel::test {

inline pcl::PointXYZRGB pointAt(double x, double y, double z) {
  pcl::PointXYZRGB p;
  p.x = static_cast<float>(x);
  p.y = static_cast<float>(y);
  p.z = static_cast<float>(z);
  return p;
}

inline pcl::Indices allOf(const ColorCloud& cloud) {
  pcl::Indices all(cloud.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<pcl::index_t>(i);
  return all;
}

/// One point in the middle of the cell for each digit d, at the height d / 5 m; '.' is empty. Row
/// r, column c of the drawing is the cell r cells in front of (x, y) = (1 m, 0) and c to its left.
inline ColorCloud drawnCloud(const std::vector<std::string>& rows, double cell_size_m = 0.05,
                             int points_per_cell = 1) {
  ColorCloud cloud;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (rows[r][c] == '.') continue;
      for (int i = 0; i < points_per_cell; ++i) {
        cloud.push_back(pointAt(1.0 + (static_cast<double>(r) + 0.5) * cell_size_m,
                                (static_cast<double>(c) + 0.5) * cell_size_m,
                                (rows[r][c] - '0') / 5.0));
      }
    }
  }
  return cloud;
}

}  // namespace heel::test
