// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the camera sees of everything, coarsely: so that the robot does not run into a table top.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_sight.hpp>
#include <heel/apps/recording/frame.hpp>
#include <heel/cloud/stereo_matcher.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// Which points of the camera are in the robot's way.
struct ObstaclePointsParams {
  int width_px = 160;        ///< Images are reduced to this width, or left as they are if smaller.
  double nearest_m = 0.45;   ///< Nearer things can't be matched; what seems to be nearer is false.
  double max_range_m = 2.0;  ///< Points further away than this on the floor are too coarse.
  double min_height_m = 0.08;  ///< Lower points are noise of the floor.
  double max_height_m = 1.2;   ///< The robot passes under higher points.
  /// What is seen so far below the floor, and by four standard deviations of the stereo's error, is
  /// seen where there is no floor: a step down.
  double min_depth_m = 0.1;
  /// A match is trusted only where the image changes by this much from one column to the next (of
  /// 256 levels): in blank surfaces it runs on from their rims. Rims are obstacle enough.
  int min_texture = 8;
  /// What gives no depth where floor should is a step, too, at its near rim: of a depth camera that
  /// looks down.
  bool needs_floor = false;
};

/// Dense depth on small images: a table top of the size of a hand is enough of an obstacle, so a
/// tenth of the pixels will do, at a tenth of the cost. Reuses its memory.
class ObstaclePoints {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  ObstaclePoints(const CameraSetup& setup, const ObstaclePointsParams& params = {});

  /// Points in the base frame; valid until the next call. Of what is below the floor, where it is
  /// seen through the floor, at height 0: four of each pixel, which is as long there as a cell.
  const std::vector<Eigen::Vector3f>& of(const Frame& frame);

  /// Whether the last frame shows what is behind a point in the base frame: all depths around it
  /// are greater. A step (at height 0) has gone when floor is seen there.
  bool seesThrough(const Eigen::Vector3f& point) const;
  /// What the last frame shows of places in the base frame; valid until the next call of of().
  DepthSight sight() const {
    return {depth_m_, camera_.left, T_base_camera_.inverse().cast<double>()};
  }

 private:
  void findTexture();
  Eigen::Vector2f floorAt(double v, double u) const;
  void addStep(int v, int u, float within_m);
  bool isBlank(int v, int u) const;
  float deepAt(float depth_m) const;
  float heightAt(int v, int u) const;
  void collect();

  SensorKind sensor_;
  StereoCamera camera_;  // of the small images
  Eigen::Isometry3f T_base_camera_;
  float deep_per_m_;  // error of a height, for each metre of depth
  ObstaclePointsParams params_;
  StereoMatcher matcher_;
  cv::Mat left_, right_, disparity_, depth_m_;
  cv::Mat grey_, slope_, texture_;    // texture_: CV_8UC1, not 0 where there is some; empty: all
  std::vector<float> unseen_from_m_;  // of each column, how far off what gives no depth begins
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace heel
