// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/robot_motion.hpp"

#include "apps/recording/bag_poses.hpp"
#include "apps/recording/stamps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace heel {

namespace fs = std::filesystem;

namespace {

constexpr double kSameTime_s = 1e-6;  // stamps are decimal fractions, their sums are not exact

}  // namespace

Eigen::Isometry3d Trajectory::transformOf(const Pose& pose) {
  return Eigen::Translation3d(pose.place) * pose.turn;
}

void Trajectory::add(double stamp_s, const Eigen::Isometry3d& pose) {
  const auto at =
      poses_.empty() || poses_.back().stamp_s < stamp_s
          ? poses_.end()
          : std::lower_bound(poses_.begin(), poses_.end(), stamp_s,
                             [](const Pose& other, double s) { return other.stamp_s < s; });
  if (at != poses_.end() && at->stamp_s == stamp_s) return;
  poses_.insert(at, {stamp_s, pose.translation(), Eigen::Quaterniond(pose.linear())});
}

std::optional<Eigen::Isometry3d> Trajectory::at(double stamp_s) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp_s,
                                      [](const Pose& pose, double s) { return pose.stamp_s < s; });
  if (after != poses_.end() && after->stamp_s == stamp_s) return transformOf(*after);
  if (after == poses_.begin() || after == poses_.end()) {
    if (poses_.empty()) return std::nullopt;
    const Pose& end = after == poses_.end() ? poses_.back() : poses_.front();
    if (std::abs(end.stamp_s - stamp_s) > params_.max_hold_s + kSameTime_s) return std::nullopt;
    return transformOf(end);
  }
  const Pose &a = *std::prev(after), &b = *after;
  if (b.stamp_s - a.stamp_s > params_.max_gap_s + kSameTime_s) return std::nullopt;
  const double share = (stamp_s - a.stamp_s) / (b.stamp_s - a.stamp_s);
  return transformOf({stamp_s, a.place + share * (b.place - a.place), a.turn.slerp(share, b.turn)});
}

std::optional<double> Trajectory::leaves_s(double from_s, double to_s, double range_m,
                                           double limit_m) const {
  std::optional<Eigen::Isometry3d> T_start_world;
  if (const auto start = at(from_s)) T_start_world = start->inverse();
  const auto is_away = [&](const Eigen::Isometry3d& pose) {
    if (!T_start_world) T_start_world = pose.inverse();
    return shiftOf_m(*T_start_world * pose, range_m) > limit_m;
  };
  for (const Pose& pose : poses_) {
    if (pose.stamp_s < from_s || pose.stamp_s > to_s) continue;
    if (is_away(transformOf(pose))) return pose.stamp_s;
  }
  const auto end = at(to_s);
  return end && is_away(*end) ? std::optional(to_s) : std::nullopt;
}

double shiftOf_m(const Eigen::Isometry3d& motion, double range_m) {
  const double turn_rad = Eigen::AngleAxisd(motion.linear()).angle();
  return motion.translation().norm() + 2.0 * range_m * std::sin(std::min(turn_rad, M_PI) / 2.0);
}

std::optional<RobotMotion> readFolderMotion(const fs::path& folder) {
  RobotMotion motion;
  if (const fs::path file = folder / "odometry.csv"; fs::exists(file)) {
    motion.frame_id = "odom";
    for (const auto& row : readRows(file, 4, "stamp_s,x_m,y_m,yaw_rad")) {
      // By way of a message, so that a folder and a bag tell the same to the last digit.
      const PoseMsg pose = toPoseMsg(FloorPose{{row[1], row[2]}, row[3]});
      motion.poses.add(row[0], poseOf(pose.position, pose.orientation));
    }
    return motion;
  }
  for (const char* name : {"groundtruth.txt", "trajectory.txt"}) {
    const fs::path file = folder / name;
    if (!fs::exists(file)) continue;
    motion.of_camera = true;
    for (const auto& row : readRows(file, 8, "stamp x y z qx qy qz qw")) {
      PointMsg place;
      setPoint(place, {row[1], row[2], row[3]});
      motion.poses.add(row[0], poseOf(place, {row[4], row[5], row[6], row[7]}));
    }
    return motion;
  }
  return std::nullopt;
}

}  // namespace heel
