// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A map of walls in large cells, for questions about where people walk.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/function_ref.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace heel {

/// The eight ways out of a cell, to the left from +X, by columns and rows.
constexpr std::array<std::array<int, 2>, 8> kWays = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cells on which a body can stand, and which of them are next to each other. A cell is known by
/// its index, row by row.
class CoarseFloor {
 public:
  /// @param map    Where one can stand.
  /// @param sight  What can be looked through; absent: the same.
  /// @param cell_size_m  Of the large cells.
  /// @param body_radius_m  The map must be free so far around a cell's middle.
  /// @throws std::invalid_argument  if the map is empty, or unless cell_size_m is positive and the
  ///         body as wide as a cell, so that no wall is missed between two cells.
  CoarseFloor(OccupancyGrid map, double cell_size_m, double body_radius_m,
              std::optional<OccupancyGrid> sight = std::nullopt);

  double cellSize_m() const { return cell_size_m_; }
  int cells() const { return width_ * height_; }
  int width() const { return width_; }
  int height() const { return height_; }

  bool isFree(int cell) const { return is_free_[static_cast<std::size_t>(cell)] != 0; }
  Eigen::Vector2d center(int cell) const;
  int cellAt(const Eigen::Vector2d& point) const;  ///< -1 beyond the map.
  /// The free cell that is nearest to a point, the first of equals; -1 if none is free.
  int nearestFree(const Eigen::Vector2d& point) const;
  /// The free cell one step along kWays[way]; -1 if there is none. No step cuts a corner.
  int neighbour(int cell, int way) const {
    return neighbours_[static_cast<std::size_t>(cell) * 8 + static_cast<std::size_t>(way)];
  }
  /// Whether the map is free within a radius of a point.
  bool isClear(const Eigen::Vector2d& point, double radius_m) const;
  /// Whether one can look along a line.
  bool sees(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// Memory for walkingDistances(), to use again.
  using Open = std::vector<std::pair<float, int>>;
  /// How far one walks from a cell to every other [m], by Dijkstra; infinite where one can't.
  /// @param is_open  Whether one can walk into a cell now.
  void walkingDistances(int from, std::vector<float>& distance_m, Open& open,
                        FunctionRef<bool(int cell)> is_open) const;
  void walkingDistances(int from, std::vector<float>& distance_m, Open& open) const {
    walkingDistances(from, distance_m, open, [](int) { return true; });
  }

 private:
  OccupancyGrid map_;
  OccupancyGrid sight_;
  double cell_size_m_;
  int width_ = 0;
  int height_ = 0;
  std::vector<char> is_free_;
  std::vector<int> neighbours_;
};

}  // namespace heel
