// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the robot of a recording was at each of its frames.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/cloud/still_check.hpp>
#include <heel/mapping/floor_pose.hpp>

#include <optional>
#include <string>

namespace heel {

/// The base frame's places in the frame of the results: of a robot that moves, its odometry's; of
/// one that stands, as far as the recording tells, the base frame itself.
///
/// A robot stands if nothing within the plan view's range is shifted by more than half of its
/// cells: that changes no more than the plan view's own grid.
class RobotPlaces {
 public:
  /// Reads how the robot of a recording that has been opened moved.
  /// @throws std::runtime_error  as Recording::readMotion().
  RobotPlaces(const Recording& recording, const CameraSetup& setup);

  /// Whether the recording tells how the robot moved, be it not at all.
  bool areKnown() const { return are_known_; }
  /// When the robot first left its place; absent if it did not, or nothing tells.
  std::optional<double> leaves_s() const { return leaves_s_; }

  /// The frame of the places of a robot that moves; empty: it stands.
  std::string odometryFrame() const { return leaves_s_ ? motion_.frame_id : std::string(); }

  /// Absent if the odometry has a gap there.
  std::optional<FloorPose> at(double stamp_s);

  /// One sentence on what is not sure about the places given so far; empty: nothing.
  std::string warning() const;

 private:
  Eigen::Isometry3d T_base_camera_;
  RobotMotion motion_;
  bool are_known_ = false;
  std::optional<double> leaves_s_;
  std::optional<Eigen::Isometry3d> T_world_motion_;  // unless the poses are the world's already
  std::optional<double> first_height_m_;
  double greatest_tilt_rad_ = 0.0, greatest_rise_m_ = 0.0;
};

/// Looks at the pictures of a recording whose log does not tell whether the robot moved.
class MotionWatch {
 public:
  MotionWatch(const RobotPlaces& robot, const CameraSetup& setup);

  void look(const Frame& frame);

  /// When the camera left its place, as it seems.
  std::optional<double> leaves_s() const { return check_ ? check_->leaves_s() : std::nullopt; }

 private:
  DepthImages depths_;
  cv::Size size_;                    // clouds may be of any
  std::optional<StillCheck> check_;  // unless there is nothing to look for, or at
};

/// A recording up to when its robot leaves its place.
class WhileItStands final : public Recording {
 public:
  WhileItStands(Recording& recording, const RobotPlaces& robot);

  bool next(Frame& frame) override;

  /// When the robot had moved, if frames were left out for that.
  std::optional<double> moved_s() const { return moved_s_; }

 private:
  Recording& recording_;
  std::optional<double> leaves_s_, moved_s_;
};

}  // namespace heel
