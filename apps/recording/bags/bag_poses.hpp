// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Between the poses of messages and ours.
#pragma once

#include <heel/apps/bag/messages.hpp>
#include <heel/mapping/floor_pose.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>

namespace heel {

/// The nearest double; a decimal time of a recording that does not count from 1970 comes out as if
/// it had been read from text.
inline double secondsOf(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }
inline std::int64_t nanosecondsOf(double s) { return std::llround(s * 1e9); }

inline Eigen::Isometry3d poseOf(const PointMsg& at, const QuaternionMsg& turn) {
  Eigen::Quaterniond q(turn.w, turn.x, turn.y, turn.z);
  if (!(q.squaredNorm() > 1e-6)) q.setIdentity();  // all zeros stand for "not given"
  // What is normalized already must not change in its last digit.
  if (std::abs(q.squaredNorm() - 1.0) > 1e-9) q.normalize();
  return Eigen::Translation3d(at.x, at.y, at.z) * q;
}

inline FloorPose floorPoseOf(const PoseMsg& pose) {
  const Eigen::Isometry3d T = poseOf(pose.position, pose.orientation);
  return {T.translation().head<2>(), std::atan2(T(1, 0), T(0, 0))};
}

template <class Point>
void setPoint(Point& message, const Eigen::Vector3d& at) {
  message.x = at.x();
  message.y = at.y();
  message.z = at.z();
}

inline QuaternionMsg quaternionOf(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

inline PoseMsg toPoseMsg(const Eigen::Isometry3d& T) {
  PoseMsg pose;
  setPoint(pose.position, T.translation());
  pose.orientation = quaternionOf(Eigen::Quaterniond(T.linear()).normalized());
  return pose;
}

inline PoseMsg toPoseMsg(const FloorPose& pose) {
  PoseMsg message;
  setPoint(message.position, {pose.position.x(), pose.position.y(), 0.0});
  message.orientation.z = std::sin(pose.yaw_rad / 2.0);
  message.orientation.w = std::cos(pose.yaw_rad / 2.0);
  return message;
}

inline TransformStampedMsg toTransform(const PoseMsg& pose, const HeaderMsg& header,
                                       const std::string& child) {
  TransformStampedMsg message;
  message.header = header;
  message.child_frame_id = child;
  setPoint(message.transform.translation, {pose.position.x, pose.position.y, pose.position.z});
  message.transform.rotation = pose.orientation;
  return message;
}

}  // namespace heel
