// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The floor plan seen from above: what people and the robot must not walk through.
#pragma once

#include <heel/apps/simulation/scene.hpp>
#include <heel/mapping/floor_pose.hpp>

#include <vector>

namespace heel {

/// A rectangle on the floor, turned.
struct FloorBox {
  Eigen::Vector2d center;
  Eigen::Vector2d axis;  ///< Unit vector along its first side.
  Eigen::Vector2d half;  ///< Half of its sides.
};

inline constexpr double kDrivesOver_m = 0.03;  ///< What is lower bars no way: a rug.

/// Walls (without their doorways), furniture up to a body's height and steps down, as flat shapes.
class FloorPlan {
 public:
  /// @param only_mapped  Leaves out what is not in the robot's map.
  /// @param low_m        And what is lower, and steps that are.
  /// @param high_m       And what hangs higher: by default than a person.
  explicit FloorPlan(const Scene& scene, bool only_mapped = false, double low_m = kDrivesOver_m,
                     double high_m = 1.9);

  /// Distance to the nearest obstacle [m]; negative inside one.
  double clearance(const Eigen::Vector2d& p) const;

  const std::vector<FloorBox>& boxes() const { return boxes_; }
  const std::vector<FloorDisc>& discs() const { return discs_; }

 private:
  std::vector<FloorBox> boxes_;
  std::vector<FloorDisc> discs_;
};

/// One solid stretch of a wall, or the part above a doorway; lengths along the wall's middle line.
struct WallPiece {
  double from_m;
  double to_m;
  double low_m;   ///< Height of its lower side.
  double high_m;  ///< Height of its upper side.
};

/// The boxes that a wall with doorways is made of. Ends reach half a thickness further, so that
/// walls meet at corners.
std::vector<WallPiece> wallPieces(const Wall& wall);

}  // namespace heel
