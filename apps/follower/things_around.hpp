// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What stands around the robot that no map shows: seen by laser and camera, or felt.
#pragma once

#include <heel/apps/follower/follower_params.hpp>
#include <heel/mapping/obstacle_layer.hpp>
#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/surroundings.hpp>

#include <optional>
#include <vector>

namespace heel {

/// A camera of the robot: ahead for people and things, or at the floor.
enum class RobotCamera { kAhead, kFloor };

/// An ObstacleLayer of what is not on the map. One step is begin(), what there is of addScan(),
/// feel(), look() and addPoints(), then finish() and apartFrom().
class ThingsAround {
 public:
  /// @param floor  The map; must outlive this.
  ThingsAround(const RobotDescription& robot, const FollowerParams& params,
               const OccupancyGrid& floor);

  /// As ObstacleLayer::begin().
  void begin(double stamp_s, const FloorPose& robot, const std::optional<FloorDisc>& target,
             const std::vector<FloorDisc>& people);
  void addScan(const LaserScan& scan, const FloorPose& T_base_scanner);
  /// Wheels that do not turn though they should are held by something that no sensor sees.
  void feel(const VelocityCommand& asked, const VelocityCommand& measured, double elapsed_s);

  /// What a picture shows: points in the base frame of then; valid until the next call.
  const std::vector<Eigen::Vector3f>& look(RobotCamera by, const Frame& frame) {
    return pictures_.at(indexOf(by)).of(frame);
  }
  /// The steps down that are known, in that frame.
  const std::vector<Eigen::Vector2d>& stepsFrom(const FloorPose& then);
  /// Takes in those points, and what the picture sees through.
  /// @param T_base_then  The base frame of then, in that of now.
  void addPoints(RobotCamera by, const std::vector<Eigen::Vector3f>& points,
                 const FloorPose& T_base_then);
  /// What the last picture ahead shows of places in its base frame.
  DepthSight sight() const { return pictures_.front().sight(); }

  void finish() { layer_.finish(); }
  /// What is no part of these people; valid until the next call.
  const OccupancyGrid& apartFrom(const std::vector<MovingPerson>& people);

  /// Where something stands first that no map shows, on the way from one place to somebody at
  /// another; nothing if it is free.
  std::optional<Eigen::Vector2d> firstBetween(const Eigen::Vector2d& from,
                                              const Eigen::Vector2d& to) const;

  const ObstacleLayer& layer() const { return layer_; }

 private:
  static std::size_t indexOf(RobotCamera by) { return static_cast<std::size_t>(by); }
  bool isMapped(const Eigen::Vector2d& place) const;

  DriveLimits body_;
  double wheels_latency_s_, mapped_within_m_, beside_people_m_, person_m_;
  const OccupancyGrid& floor_;
  ObstacleLayer layer_;
  std::vector<ObstaclePoints> pictures_;  // of each camera
  FloorPose robot_;
  OccupancyGrid apart_;                    // the layer's window, people apart
  double stalled_s_ = 0.0;                 // so long the wheels have not turned, though they should
  std::vector<Eigen::Vector3f> unmapped_;  // points in the base frame
  std::vector<Eigen::Vector2d> steps_;
};

}  // namespace heel
