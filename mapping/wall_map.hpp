// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The walls that do not move, cell by cell in three dimensions: where they are, and what they
/// hide.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Geometry>

#include <memory>

namespace octomap {
class OcTree;
}

namespace heel {

/// Heights over the floor, from the lower to the upper [m].
struct HeightBand {
  double low_m = 0.0;   ///< Lower end.
  double high_m = 2.0;  ///< Upper end.

  /// What a level scanner at this height sees: its plane, as exactly as one can measure where it
  /// is. A low one looks under what stands on feet, which a thicker band would show as a wall.
  static constexpr HeightBand around(double height_m) {
    return {height_m - 0.005, height_m + 0.005};
  }
};

/// The heights at which a robot or a person can bump into something.
inline constexpr HeightBand kBodyBand{0.05, 1.9};

/// Walls, and what else a map shows, on OctoMap. Read-only: all queries may be asked from many
/// threads at once.
///
/// Decided once, here: **what is unknown is not a wall**. Nothing unknown hides or blocks anything;
/// only floorGrid() tells it from what is known to be free.
class WallMap {
 public:
  /// @param tree  Not null, and not changed any more by anybody.
  explicit WallMap(std::shared_ptr<const octomap::OcTree> tree);

  double cell_size_m() const;

  /// Whether a wall's cell holds the point of the world.
  bool isWall(const Eigen::Vector3d& point) const;

  /// How far it is from `from` towards `to` to the first face of a wall [m]: 0 if `from` is in
  /// one, infinite if there is none up to `to`. A point that is not finite sees nothing: 0.
  double firstWall(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Whether `to` can be seen from `from`. A wall does not count if it is hit less than `margin_m`
  /// before `to`: there it may just as well be behind it.
  bool lineOfSight(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   double margin_m = 0.0) const;

  /// A height band seen from above. A cell is occupied if a wall is anywhere in the band over it;
  /// free if any of the band, or the lowest cell over the floor, is known to be free; else unknown.
  /// A band begins with the first cell that is all in it, unless it is thinner than a cell: so the
  /// floor is no wall, however large cells are.
  /// Covers all that is known; empty if nothing is.
  /// @throws std::invalid_argument  unless the band's low is under its high.
  /// @throws std::runtime_error     if the map spans more floor than there may be memory for.
  OccupancyGrid floorGrid(const HeightBand& band = kBodyBand) const;

  /// What work on the floorGrid takes of memory, about.
  std::size_t floorBytes() const;

  /// The tree itself, e.g. for collision checks with FCL.
  const std::shared_ptr<const octomap::OcTree>& tree() const { return tree_; }

 private:
  Eigen::AlignedBox2i floorCells() const;

  std::shared_ptr<const octomap::OcTree> tree_;
};

}  // namespace heel
