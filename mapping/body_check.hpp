// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Whether the robot's body fits: FCL's checks against the map's octree and the obstacle layer.
#pragma once

#include <heel/mapping/floor_pose.hpp>

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace octomap {
class OcTree;
}

namespace heel {

class ObstacleLayer;

/// A round footprint around the base's origin.
struct RoundFootprint {
  double radius_m = 0.26;
};

/// A rectangular footprint, along the base's axes.
struct BoxFootprint {
  double length_m = 0.5;  ///< Along X.
  double width_m = 0.4;   ///< Along Y.
  double ahead_m = 0.0;   ///< How far its middle is ahead of the base's origin.
};

/// The robot's shape: its footprint, drawn up. The defaults are a Pioneer 3-DX with a camera mast.
struct RobotBody {
  std::variant<RoundFootprint, BoxFootprint> footprint = RoundFootprint{};
  /// What is lower does not touch the body: the floor, when the map holds it, and sills.
  double bottom_m = 0.06;
  double top_m = 1.1;
};

/// Checks poses of one body in one map.
///
/// Collision is what FCL's collide() says; it is the reliable test and much the faster one, so ask
/// with a margin where a clearance would only be compared. Unknown space does not collide.
/// Obstacles of a layer are columns as high as the body.
///
/// All methods are const and may be called from several threads.
class BodyCheck {
 public:
  /// @param walls  Copied as it is now, with its occupancy threshold: later changes have no effect
  ///               here. May be empty.
  /// @throws std::invalid_argument  if the body has no volume.
  BodyCheck(const RobotBody& body, const octomap::OcTree& walls);
  BodyCheck(BodyCheck&& other) noexcept;
  BodyCheck& operator=(BodyCheck&& other) noexcept;
  ~BodyCheck();

  const RobotBody& body() const;

  /// Whether the body, grown by a margin on its sides, touches a wall. A box grows to a box, so at
  /// its corners by more than the margin.
  /// @throws std::invalid_argument  if a number is not finite or the margin is negative.
  bool collides(const FloorPose& T_world_base, double margin_m = 0.0) const;

  /// The same with walls and the layer's obstacles.
  bool collides(const FloorPose& T_world_base, const ObstacleLayer& layer,
                double margin_m = 0.0) const;

  /// From the body to the nearest wall [m], in space: 0 in a collision, infinite without walls.
  /// Where nothing is as near as `up_to_m`, that is the answer, and found sooner.
  /// @throws std::invalid_argument  if a number of the pose is not one, or `up_to_m` is negative.
  double clearance(const FloorPose& T_world_base,
                   double up_to_m = std::numeric_limits<double>::infinity()) const;

  /// The same with walls and the layer's obstacles.
  double clearance(const FloorPose& T_world_base, const ObstacleLayer& layer,
                   double up_to_m = std::numeric_limits<double>::infinity()) const;

  /// The first pose of a path at which, or on the straight way from the pose before it, the body
  /// collides; nothing if the path is clear.
  /// @param layer     None: walls only.
  /// @param step_m    No part of the body moves further than this from check to check.
  /// @throws std::invalid_argument  as `collides`, or unless the step is positive.
  std::optional<std::size_t> firstCollision(const std::vector<FloorPose>& path,
                                            const ObstacleLayer* layer = nullptr,
                                            double margin_m = 0.0, double step_m = 0.02) const;

 private:
  struct Geometry;  // keeps FCL's heavy headers out of here
  std::unique_ptr<const Geometry> geometry_;
};

}  // namespace heel
