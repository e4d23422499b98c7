// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One moment of following as a picture of a film: what the robot sees, and where everybody is.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>
#include <heel/planning/trajectory.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// What one picture shows. All places are in the map's frame.
struct FollowVideoFrame {
  /// The left image with its mask, blobs and tracks; its places in the map's frame, so that
  /// `T_floor_camera` is the camera's true pose in the world. Its header says state and reason.
  DrawnFrame view;
  FloorPose robot_true;
  FloorPose robot_estimated;
  double position_sigma_m = 0.0;  ///< Drawn around the estimated pose if above 0.
  std::optional<Eigen::Vector2d> person_true;
  std::optional<Eigen::Vector2d> target_estimate;
  std::vector<Eigen::Vector2d> others_true;
  std::vector<Eigen::Vector2d> obstacles;  ///< Middles of the obstacle layer's cells.
  double obstacle_cell_m = 0.05;
  std::vector<Eigen::Vector2d> path;  ///< That the robot plans to go.
  std::vector<Eigen::Vector2d> robot_trail, person_trail;
};

/// Draws the pictures of one film.
class FollowVideo {
 public:
  /// @param map  Its walls are drawn once, and bound what the camera is shown to see. Without any
  ///             the robot's surroundings are shown.
  /// @throws std::invalid_argument  if the map is empty.
  FollowVideo(const OccupancyGrid& map, const DriveLimits& robot);

  /// Size of the pictures; both numbers are even, as films need it.
  cv::Size size() const;

  /// @param picture  Out: CV_8UC3 of size(); its memory is reused.
  void draw(const FollowVideoFrame& frame, cv::Mat& picture);

  /// Where a place of the map is in a picture [px].
  cv::Point2d pixelOf(const Eigen::Vector2d& place_m) const;

 private:
  cv::Rect imageArea() const;
  cv::Rect mapArea() const;
  cv::Point2d onMap(const Eigen::Vector2d& place_m) const;  ///< In the map's own panel.
  std::vector<cv::Point2d> onMap(const std::vector<Eigen::Vector2d>& places_m) const;
  void drawMap();
  std::vector<Eigen::Vector2d> seenArea(const DrawnFrame& view) const;
  std::vector<cv::Point2d> bodyAt(const FloorPose& pose, double wider_m = 0.0) const;
  void drawRobot(const FollowVideoFrame& frame, cv::Mat& panel) const;
  void drawPeople(const FollowVideoFrame& frame, cv::Mat& panel) const;
  void drawObstacles(const FollowVideoFrame& frame, cv::Mat& panel) const;

  OccupancyGrid grid_;
  DriveLimits robot_;
  Eigen::AlignedBox2d bounds_m_;
  bool goes_along_ = false;  ///< The panel shows where the robot is.
  double scale_ = 1.0;       ///< Pixels a metre on the map.
  cv::Mat map_;              ///< The map's panel with nothing but walls.
};

}  // namespace heel
