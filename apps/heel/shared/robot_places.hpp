// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the robot of a recording was at each of its frames.
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/cloud/still_check.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/localization.hpp>
#include <heel/mapping/wall_map.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace heel {

inline constexpr const char* kMapFrame = "map";  ///< Of REP-105.

/// The map that the robot of a log is found on, as a user names it.
struct LogMapOptions {
  std::string map;              ///< See mapSource(); empty: there is none.
  std::vector<double> start;    ///< X,Y,YAW of the robot at first; empty: the log tells, or nobody.
  std::vector<double> scanner;  ///< X,Y,YAW of the scanner on the robot; empty: the log tells.
};

/// Adds --robot-start, --scanner and --scan-topic; the caller adds --map.
void addLogMap(CLI::App& verb, LogMapOptions& options, BagTopics& topics);

/// The same, read.
struct LogMap {
  std::shared_ptr<const WallMap> walls;  ///< Null: there is none.
  std::optional<FloorPose> start;        ///< Else from tf, the log's reference, or anywhere.
  std::optional<FloorPose> scanner;  ///< In the base frame; else the log's own, else the scene's.
  /// Where nothing else tells it: what the robot's file says, or the scene.
  std::optional<FloorPose> default_scanner;
  double scanner_height_m = 0.3;  ///< The same of its height.
  LocalizationParams localization;

  void setScanner(const FloorPose& T_base_scanner, double height_m) {
    default_scanner = T_base_scanner;
    scanner_height_m = height_m;
  }
};

/// @throws std::runtime_error  as mapSource() and openMap().
LogMap openLogMap(const LogMapOptions& options);

/// Where the laser is on the robot, and its plane over the floor.
struct ScannerPlace {
  FloorPose T_base_scanner;
  double height_m = 0.0;
  std::vector<std::string> warnings;  ///< What a user should know of the laser, in sentences.
};

/// As the options say, else the log, else what `map` has by default; else, with a warning, at the
/// base's origin.
ScannerPlace placeScanner(const LaserLog& scans, const LogMap& map, const CameraSetup& setup);

/// The laser of a log, and where it is on the robot.
struct LogLaser {
  std::unique_ptr<LaserLog> scans;
  ScannerPlace place;
};

/// @throws std::runtime_error  as openLaserLog().
LogLaser openLogLaser(const std::filesystem::path& path, const BagTopics& topics, const LogMap& map,
                      const CameraSetup& setup);

/// How the robot moved on its map, as the tf of its bag tells; absent if it does not.
/// @throws std::runtime_error  as openRecording().
std::optional<RobotMotion> motionInMap(const std::filesystem::path& path,
                                       const RecordingParams& opening);

/// Where the robot is on its map at a moment: as it is given, as tf tells (`in_map`), or as the
/// log's reference of that moment does; absent if nothing tells.
std::optional<FloorPose> startOnMap(const LogMap& map, const std::optional<RobotMotion>& in_map,
                                    const LaserReading& first, const CameraSetup& setup);

/// The base frame's places in the frame of the results: on a map, the map's; else of a robot that
/// moves, its odometry's; of one that stands, as far as the recording tells, the base frame itself.
///
/// A robot stands if nothing within the plan view's range is shifted by more than half of its
/// cells: that changes no more than the plan view's own grid.
class RobotPlaces {
 public:
  /// Reads how the robot of a recording that has been opened moved.
  /// @throws std::runtime_error  as Recording::readMotion().
  RobotPlaces(const Recording& recording, const CameraSetup& setup);

  /// From now on places are on the map: by the log's laser scans and odometry, or where it has no
  /// scans, by what tf says of the robot in the frame `map`. Without a start that is given, tf's
  /// place in `map` is the first, else the log's reference (a topic or table of the truth), else
  /// the robot is looked for everywhere.
  /// @return  What a user should know of the laser, in sentences.
  /// @throws std::runtime_error  one sentence, if the recording has neither.
  std::vector<std::string> putOnMap(const std::filesystem::path& path,
                                    const RecordingParams& opening, const LogMap& map);

  /// Whether the recording tells how the robot moved, be it not at all.
  bool areKnown() const { return are_known_; }
  /// When the robot first left its place; absent if it did not, or nothing tells.
  std::optional<double> leaves_s() const { return leaves_s_; }

  /// The frame of the places; empty: the base frame of a robot that stands.
  std::string frame() const;

  /// Absent if the odometry has a gap there, or the robot is not found on the map.
  /// @param stamp_s  Not before that of the call before, if it is on a map.
  /// @param people   Places of those who hide walls from the laser, in the frame of the results.
  std::optional<RobotPlace> at(double stamp_s, const std::vector<Eigen::Vector2d>& people = {});
  /// Why the last place is absent.
  const std::string& whyAbsent() const { return why_absent_; }
  /// Whether it is because the robot is not found on the map.
  bool isLost() const { return is_lost_; }

  /// One sentence on what is not sure about the places given so far; empty: nothing.
  std::string warning() const;

 private:
  std::optional<FloorPose> odometryAt(double stamp_s);
  void takeScans(double until_s, const std::vector<Eigen::Vector2d>& people);

  CameraSetup setup_;
  RobotMotion motion_;
  bool are_known_ = false;
  std::optional<double> leaves_s_;
  std::optional<Eigen::Isometry3d> T_world_motion_;  // unless the poses are the world's already
  std::optional<double> first_height_m_;
  double greatest_tilt_rad_ = 0.0, greatest_rise_m_ = 0.0;

  bool on_map_ = false;
  std::unique_ptr<LaserLog> scans_;  // null: tf tells the places on the map
  LaserReading scan_;                // the next one, if there is one
  bool has_scan_ = false;
  std::unique_ptr<Localization> localization_;
  LogMap map_;
  std::optional<RobotMotion> in_map_;       // as tf tells
  std::optional<FloorPose> scan_odometry_;  // of the last scan
  std::vector<FloorDisc> masked_;
  std::string why_absent_;
  bool is_lost_ = false;
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
