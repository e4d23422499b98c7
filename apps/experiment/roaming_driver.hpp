// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Drives a simulated robot about, so that something else can be measured.
#pragma once

#include <heel/apps/simulation/random.hpp>
#include <heel/apps/simulation/simulator.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <vector>

namespace heel {

/// Goes from one random goal to the next over free cells and waits for people in its way. It knows
/// the truth, as it is no part of what is measured.
class RoamingDriver {
 public:
  /// @param scene  With all its furniture, in the map or not.
  RoamingDriver(const Scene& scene, std::uint64_t seed);

  /// A pose with room around it and the people of the scene's start.
  FloorPose randomPose();

  VelocityCommand drive(const WorldTruth& truth);

 private:
  void chooseGoal(const Eigen::Vector2d& from);
  bool findWay();
  double wayFrom(const GridCell& cell) const;

  RandomStream random_;
  std::vector<Eigen::Vector2d> people_;
  OccupancyGrid room_;  // Occupied where the robot's middle should not be.
  std::vector<GridCell> free_;
  std::vector<float> way_m_;  // To the goal, cell by cell.
  Eigen::Vector2d goal_ = Eigen::Vector2d::Zero();
  bool has_goal_ = false;
  int stuck_ = 0;
};

}  // namespace heel
