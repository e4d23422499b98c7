// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/wall_gate.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/segmentation/plan_view.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace heel {

RobotPlaces::RobotPlaces(const Recording& recording, const CameraSetup& setup)
    : T_base_camera_(setup.T_base_camera) {
  auto motion = recording.readMotion();
  if (!motion) return;
  motion_ = std::move(*motion);
  are_known_ = true;
  const double from_s = recording.info().first_s;
  const PlanViewParams plan;
  leaves_s_ = motion_.poses.leaves_s(from_s, from_s + recording.info().duration_s, plan.max_range_m,
                                     plan.cell_size_m / 2.0);
  if (!motion_.frame_id.empty()) {
    T_world_motion_ = Eigen::Isometry3d::Identity();
  } else {
    motion_.frame_id = "odom";
  }
}

std::optional<FloorPose> RobotPlaces::at(double stamp_s) {
  if (!leaves_s_) return FloorPose();
  const auto pose = motion_.poses.at(stamp_s);
  if (!pose) return std::nullopt;
  const Eigen::Isometry3d T_motion_base =
      motion_.of_camera ? *pose * T_base_camera_.inverse() : *pose;
  if (!T_world_motion_) T_world_motion_ = T_motion_base.inverse();
  const Eigen::Isometry3d T = *T_world_motion_ * T_motion_base;
  if (!first_height_m_) first_height_m_ = T.translation().z();
  greatest_rise_m_ = std::max(greatest_rise_m_, std::abs(T.translation().z() - *first_height_m_));
  greatest_tilt_rad_ = std::max(greatest_tilt_rad_, std::acos(std::clamp(T(2, 2), -1.0, 1.0)));
  return FloorPose{T.translation().head<2>(), std::atan2(T(1, 0), T(0, 0))};
}

std::string RobotPlaces::warning() const {
  const MountingTolerance tolerance;
  if (leaves_s_ &&
      (greatest_tilt_rad_ > tolerance.angle_rad || greatest_rise_m_ > tolerance.height_m)) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "the camera tilts by up to %.1f deg and rises by up to %.2f m as it moves, but is "
        "taken to keep its place over a level floor: heights and places are off",
        greatest_tilt_rad_ * 180.0 / M_PI, greatest_rise_m_);
    return text;
  }
  return leaves_s_ ? motion_.warning : std::string();
}

MotionWatch::MotionWatch(const RobotPlaces& robot, const CameraSetup& setup)
    : depths_(setup.sensor, setup.camera),
      size_(setup.camera.left.width, setup.camera.left.height) {
  if (robot.areKnown() || !(setup.camera.left.fx > 0.0)) return;
  const bool is_stereo = setup.sensor == SensorKind::kStereo;
  check_.emplace(setup.camera.left, setup.T_base_camera,
                 is_stereo ? depthErrorOf(setup.camera) : 0.0);
}

void MotionWatch::look(const Frame& frame) {
  if (!check_ || !check_->isDue(frame.stamp_s) || frame.image_bgr.size() != size_) return;
  check_->add(frame.stamp_s, depths_.of(frame));
}

WhileItStands::WhileItStands(Recording& recording, const RobotPlaces& robot)
    : recording_(recording), leaves_s_(robot.leaves_s()) {
  info_ = recording.info();
}

bool WhileItStands::next(Frame& frame) {
  const bool is_there = recording_.next(frame);
  skipped_ = recording_.skipped();
  if (is_there && leaves_s_ && frame.stamp_s >= *leaves_s_) moved_s_ = leaves_s_;
  return is_there && !moved_s_;
}

}  // namespace heel
