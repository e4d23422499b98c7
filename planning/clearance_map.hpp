// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How far away blocked floor is, and whether a round body can go straight from here to there.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace heel {

/// A map's blocked cells, taken as whole squares, and the distance of every cell's middle to the
/// nearest of them. Outside the map all is blocked. A layer of further blocked cells (what stands
/// there now and is not in the map) can be laid over it and taken away.
class ClearanceMap {
 public:
  /// @param reach_m  Distances are told up to here; further away counts as this far.
  /// @throws std::invalid_argument  if the map is empty or the reach is not positive.
  ClearanceMap(const OccupancyGrid& map, double reach_m, bool unknown_is_free = false);

  /// Lays this layer in place of the last one; a cell is blocked where a disc, or an occupied cell
  /// of `cells` (which may have another cell size), covers a part of it.
  /// @return  the cells whose distance has changed, until the next call.
  /// @throws std::invalid_argument  if a disc is not finite.
  const std::vector<int>& setLayer(const std::vector<FloorDisc>& discs,
                                   const OccupancyGrid* cells = nullptr);

  int width() const { return width_; }
  int height() const { return height_; }
  double cell_size_m() const { return cell_size_m_; }
  double reach_m() const { return reach_ * cell_size_m_; }
  bool isInside(const Eigen::Vector2d& point) const;
  /// Index of the cell that holds a point which is inside.
  int cellOf(const Eigen::Vector2d& point) const;
  Eigen::Vector2d centerOf(int cell) const {
    return origin_m_ + cell_size_m_ * Eigen::Vector2d(cell % width_ + 0.5, cell / width_ + 0.5);
  }

  bool isBlocked(int cell) const { return blocked_[index(cell)] != 0; }
  /// Distance of a cell's middle to the nearest blocked square, in cells.
  float clearanceInCells(int cell) const { return clearance_[index(cell)]; }
  /// Distance of a point to the nearest blocked square [m]; 0 on one, and outside.
  double clearance(const Eigen::Vector2d& point) const;

  /// Whether a disc of this radius that goes straight from `a` to `b` stays off every blocked
  /// square. Exact: what the disc sweeps is cut into the rows of cells.
  bool isClear(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius_m) const;

 private:
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  void addToLayer(int x0, int y0, int x1, int y1, const FloorDisc* disc);
  void findNextBlocked(int row);
  void measure(int x0, int y0, int x1, int y1);

  Eigen::Vector2d origin_m_;
  double cell_size_m_;
  int width_;
  int height_;
  double reach_;  ///< In cells.
  /// Bits: in the map, in the layer, in the layer that is being laid.
  std::vector<std::uint8_t> blocked_;
  std::vector<int> next_blocked_;  ///< First blocked column from here on; the width if none.
  std::vector<float> clearance_;
  std::vector<float> column_;  ///< Squared distance to the nearest blocked cell of the column.
  std::vector<int> steps_;     ///< Rows since the last blocked cell, per column.
  std::vector<float> row_;
  std::vector<int> layer_, next_layer_, changed_;
};

}  // namespace heel
