// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/robot_motion.hpp>
#include <heel/apps/recording/stamps.hpp>
#include <heel/apps/recording/time_span.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace heel {

namespace fs = std::filesystem;

namespace {

constexpr double kFurthest_m = 1e8;  // from any origin, on Earth

}  // namespace

Eigen::Isometry3d Trajectory::transformOf(const Pose& pose) {
  return Eigen::Translation3d(pose.place) * pose.turn;
}

void Trajectory::add(double stamp_s, const Eigen::Isometry3d& pose) {
  if (!std::isfinite(stamp_s) || !pose.matrix().allFinite() ||
      pose.translation().norm() > kFurthest_m) {
    return;
  }
  poses_.try_emplace(poses_.end(), stamp_s,
                     Pose{pose.translation(), Eigen::Quaterniond(pose.linear())});
}

std::vector<double> Trajectory::stamps_s() const {
  std::vector<double> stamps_s;
  stamps_s.reserve(poses_.size());
  for (const auto& [stamp_s, pose] : poses_) stamps_s.push_back(stamp_s);
  return stamps_s;
}

std::optional<Eigen::Isometry3d> Trajectory::at(double stamp_s) const {
  if (poses_.empty()) return std::nullopt;
  const auto after = poses_.lower_bound(stamp_s);
  if (after != poses_.end() && after->first == stamp_s) return transformOf(after->second);
  if (after == poses_.begin() || after == poses_.end()) {
    const auto& [end_s, end] = after == poses_.end() ? *poses_.rbegin() : *after;
    if (std::abs(end_s - stamp_s) > params_.max_hold_s + kSameTime_s) return std::nullopt;
    return transformOf(end);
  }
  const auto& [a_s, a] = *std::prev(after);
  const auto& [b_s, b] = *after;
  if (b_s - a_s > params_.max_gap_s + kSameTime_s) return std::nullopt;
  const double share = (stamp_s - a_s) / (b_s - a_s);
  return transformOf({a.place + share * (b.place - a.place), a.turn.slerp(share, b.turn)});
}

std::optional<double> Trajectory::leaves_s(double from_s, double to_s, double range_m,
                                           double limit_m) const {
  std::optional<Eigen::Isometry3d> T_start_world;
  if (const auto start = at(from_s)) T_start_world = start->inverse();
  const auto is_away = [&](const Eigen::Isometry3d& pose) {
    if (!T_start_world) T_start_world = pose.inverse();
    return shiftOf_m(*T_start_world * pose, range_m) > limit_m;
  };
  for (auto pose = poses_.lower_bound(from_s); pose != poses_.end() && pose->first <= to_s;
       ++pose) {
    if (is_away(transformOf(pose->second))) return pose->first;
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
