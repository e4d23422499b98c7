// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How the robot of a recording moved, as its log tells.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Between which poses a place is known.
struct TrajectoryParams {
  /// Poses further apart are not joined. A robot that swerves or brakes at 0.5 m/s^2 leaves the
  /// straight line between them by 0.06 m in this time (a t^2 / 8): about a cell of the plan view.
  double max_gap_s = 1.0;
  /// The first and last pose hold for so long before and after: at 0.5 m/s, the same error.
  double max_hold_s = 0.1;
};

/// The poses of one thing, by time.
class Trajectory {
 public:
  explicit Trajectory(const TrajectoryParams& params = {}) : params_(params) {}

  /// In any order of time; of two poses of one time, the first counts. One that is not finite, or
  /// of a place where no robot is, is left out.
  void add(double stamp_s, const Eigen::Isometry3d& pose);

  bool empty() const { return poses_.empty(); }
  std::size_t size() const { return poses_.size(); }
  std::vector<double> stamps_s() const;

  /// On the straight way between the poses before and after; absent where there are none within
  /// the limits.
  std::optional<Eigen::Isometry3d> at(double stamp_s) const;

  /// When it is first further from where it was at `from_s` than `limit_m`, for some point within
  /// `range_m` of it; absent if that is not before `to_s`. Without a pose at `from_s`, the first
  /// one after it counts.
  std::optional<double> leaves_s(double from_s, double to_s, double range_m, double limit_m) const;

 private:
  struct Pose {
    Eigen::Vector3d place;
    Eigen::Quaterniond turn;
  };
  static Eigen::Isometry3d transformOf(const Pose& pose);

  TrajectoryParams params_;
  std::map<double, Pose> poses_;  // by time
};

/// How far a motion takes a point within `range_m` of its origin at the most. [m]
double shiftOf_m(const Eigen::Isometry3d& motion, double range_m);

/// How a robot moved.
struct RobotMotion {
  Trajectory poses;
  /// The frame of the poses: X forward and Z up at the start, the floor at z = 0. Empty: it is not
  /// known how that frame lies, only that it stands still.
  std::string frame_id;
  bool of_camera = false;  ///< Poses are of the camera's optical frame; else of the base frame.
  std::string warning;     ///< One sentence on what is not sure about them, or empty.
};

/// The motion that a recording's folder tells of: odometry.csv ("stamp_s,x_m,y_m,yaw_rad" of the
/// base frame, as `heel simulate` writes it), else groundtruth.txt or trajectory.txt of the TUM
/// layout ("stamp x y z qx qy qz qw" of the camera). Absent if there is none of them.
/// @throws std::runtime_error  one sentence with file and line, if a line is broken.
std::optional<RobotMotion> readFolderMotion(const std::filesystem::path& folder);

}  // namespace heel
