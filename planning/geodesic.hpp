// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far it is to walk from one place to every other.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/clearance_map.hpp>
#include <heel/planning/grid_wave.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// Shortest ways from a point to all free cells, around what is in the way, for a round body: as a
/// navigation function, or to ask where somebody can have got to. By 16 moves on the grid, so a
/// distance is at most 2.8 % too long. No allocation once warm.
class GeodesicField {
 public:
  /// @param radius_m  Of the body; cells nearer to something than this are not free.
  /// @throws std::invalid_argument  if the map is empty or the radius is not positive.
  GeodesicField(const OccupancyGrid& map, double radius_m, bool unknown_is_free = false);
  GeodesicField(const GeodesicField&) = delete;
  GeodesicField& operator=(const GeodesicField&) = delete;

  /// Takes these, in place of those before, as blocked besides the map; call measureFrom() again.
  void setObstacles(const std::vector<FloorDisc>& discs, const OccupancyGrid* cells = nullptr);

  /// Measures from the free place nearest to `point`.
  /// @param within_m  How far away that place may be.
  /// @return  false if there is none; all distances are then infinite.
  bool measureFrom(const Eigen::Vector2d& point, double within_m = 0.5);

  /// Way from the point to the middle of the cell that holds `place` [m]; infinity where the body
  /// can't get to or stand.
  float distance(const Eigen::Vector2d& place) const;
  /// The same for all cells, in the map's order.
  const std::vector<float>& distances_m() const { return distances_m_; }
  /// The cells that can be reached, by their index in the map.
  const std::vector<int>& reached() const { return wave_.touched(); }

  const ClearanceMap& clearance() const { return map_; }

 private:
  ClearanceMap map_;
  GridWave wave_;
  std::vector<float> distances_m_;
  std::vector<int> near_;
  std::vector<WaveSeed> seeds_;
};

}  // namespace heel
