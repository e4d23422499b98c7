// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The floor, seen from above, cell by cell: what is free, what is not, what nobody knows.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

enum class Occupancy : std::uint8_t { kFree, kOccupied, kUnknown };

/// Whether cells of a floor may have an edge of this length.
constexpr bool isCellSize(double cell_size_m) {
  return cell_size_m >= 1e-4 && cell_size_m <= 100.0;  // not NaN
}

/// A cell of a grid, by column and row.
struct GridCell {
  int x = 0;
  int y = 0;
  friend bool operator==(const GridCell& a, const GridCell& b) { return a.x == b.x && a.y == b.y; }
};

/// Cells over a rectangle of the floor, row by row from the corner of least x and y, in world axes.
class OccupancyGrid {
 public:
  OccupancyGrid() = default;
  /// @param origin_m  Corner of cell (0, 0) in the world.
  /// @throws std::invalid_argument  unless the sizes are positive and the origin is finite.
  OccupancyGrid(const Eigen::Vector2d& origin_m, double cell_size_m, int width, int height,
                Occupancy fill = Occupancy::kFree);

  /// Moves the corner of cell (0, 0); the cells keep what they hold.
  /// @throws std::invalid_argument  unless the origin is finite.
  void setOrigin(const Eigen::Vector2d& origin_m);

  const Eigen::Vector2d& origin_m() const { return origin_m_; }
  double cell_size_m() const { return cell_size_m_; }
  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return cells_.empty(); }

  bool contains(const GridCell& c) const {
    return c.x >= 0 && c.y >= 0 && c.x < width_ && c.y < height_;
  }
  std::size_t index(const GridCell& c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(c.x);
  }
  /// The cell that holds `point`, which may be outside the grid.
  GridCell cellAt(const Eigen::Vector2d& point) const;
  /// The middle of a cell.
  Eigen::Vector2d center(const GridCell& c) const {
    return origin_m_ + cell_size_m_ * Eigen::Vector2d(c.x + 0.5, c.y + 0.5);
  }

  Occupancy& at(const GridCell& c) { return cells_[index(c)]; }
  Occupancy at(const GridCell& c) const { return cells_[index(c)]; }
  /// What is at a point; unknown outside the grid.
  Occupancy at(const Eigen::Vector2d& point) const;

  /// Whether a part of an occupied cell is no further from a point than `radius_m`. Looks at every
  /// cell around it: for radii of a few cells.
  bool isOccupiedWithin(const Eigen::Vector2d& point, double radius_m) const;

  const std::vector<Occupancy>& cells() const { return cells_; }

 private:
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  double cell_size_m_ = 0.0;
  int width_ = 0;
  int height_ = 0;
  std::vector<Occupancy> cells_;
};

}  // namespace heel
