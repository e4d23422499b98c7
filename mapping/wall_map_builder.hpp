// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How a wall map comes to be: from a plan's solids, from a floor plan, from clouds.
#pragma once

#include <heel/mapping/wall_map.hpp>

#include <Eigen/Geometry>

#include <memory>
#include <vector>

namespace heel {

/// An upright box that is turned about its vertical.
struct WallBox {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  ///< Along its own axes.
  HeightBand band;
};

/// An upright cylinder.
struct WallCylinder {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  HeightBand band;
};

/// Collects walls into a map.
///
/// A cell is wall where its middle lies in a solid. A solid that is thinner than a cell counts as
/// one cell thick, so that no wall has a hole that a ray finds.
class WallMapBuilder {
 public:
  /// @throws std::invalid_argument  unless the cell's edge is positive.
  explicit WallMapBuilder(double cell_size_m = 0.05);
  ~WallMapBuilder();
  WallMapBuilder(WallMapBuilder&& other) noexcept;
  WallMapBuilder& operator=(WallMapBuilder&& other) noexcept;

  /// @throws std::invalid_argument  if the solid is not finite, has a negative size, or reaches
  ///         further than the tree (1.6 km at the default cell).
  /// @throws std::runtime_error  as all that adds, if the cells take more memory than is allowed.
  void add(const WallBox& box);
  void add(const WallCylinder& cylinder);  ///< As for boxes.

  /// Marks a rectangle of floor as known to be free where no wall is: of a plan, one layer of cells
  /// over the floor says so.
  void addFreeFloor(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  /// Extrudes a floor plan's walls from the floor to `height_m`; its free cells are free floor. Of
  /// the plan's cells and the map's, neither's wall is lost if they differ in size or place.
  void add(const OccupancyGrid& plan, double height_m = 2.0);

  /// Adds what a depth camera saw from a known pose, by OctoMap's probabilities: its points are
  /// walls, and the rays to them free.
  /// @param points_m  In the camera's frame; those that are not finite are left out.
  /// @param max_range_m  Of longer rays only the beginning counts, as free.
  void add(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Isometry3d& T_world_camera,
           double max_range_m = 5.0);

  /// The map of all that was added. The builder is empty afterwards.
  WallMap build();

 private:
  std::unique_ptr<octomap::OcTree> tree_;
};

}  // namespace heel
