// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/segmentation/plan_view.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace heel {
namespace {

FloorPose onFloor(const Eigen::Isometry3d& T) {
  return {T.translation().head<2>(), std::atan2(T(1, 0), T(0, 0))};
}

FloorPose floorPoseOf(const std::vector<double>& x_y_yaw) {
  return {{x_y_yaw[0], x_y_yaw[1]}, x_y_yaw[2]};
}

}  // namespace

void addLogMap(CLI::App& verb, LogMapOptions& options, BagTopics& topics) {
  verb.add_option(
          "--robot-start", options.start,
          "where the robot is on the map at first [m, m, rad] (default: as tf's frame 'map' "
          "or the truth of a log tells, else it is looked for everywhere)")
      ->delimiter(',')
      ->expected(3)
      ->option_text("X,Y,YAW");
  verb.add_option(
          "--scanner", options.scanner,
          "the laser's place on the robot [m, m, rad] (default: by tf, or as --config or the "
          "scene of --map tells; else of a log 0,0,0, and 'live' waits)")
      ->delimiter(',')
      ->expected(3)
      ->option_text("X,Y,YAW");
  addScanTopic(verb, topics);
}

LogMap openLogMap(const LogMapOptions& options) {
  LogMap map;
  if (!options.map.empty()) {
    const std::filesystem::path file = mapSource(options.map);
    SourcedMap sourced = openMap(file);
    if (sourced.source == "scene") {
      const Eigen::Vector3d at = loadScene(file.string()).robot.laser.at;
      map.setScanner({at.head<2>(), 0.0}, at.z());
    }
    map.walls = std::make_shared<const WallMap>(std::move(sourced.map));
  }
  if (!options.start.empty()) map.start = floorPoseOf(options.start);
  if (!options.scanner.empty()) map.scanner = floorPoseOf(options.scanner);
  return map;
}

ScannerPlace placeScanner(const LaserLog& scans, const LogMap& map, const CameraSetup& setup) {
  ScannerPlace result;
  result.warnings = scans.warnings();
  std::optional<FloorPose> place = map.scanner ? map.scanner : scans.T_base_scanner();
  if (!place) place = map.default_scanner;
  if (!place && !scans.unplaced().empty()) result.warnings.push_back(scans.unplaced());
  result.T_base_scanner = place.value_or(FloorPose());
  const auto over_base_m = scans.scannerHeight_m();
  result.height_m = over_base_m ? *over_base_m + setup.base_height_m : map.scanner_height_m;
  return result;
}

LogLaser openLogLaser(const std::filesystem::path& path, const BagTopics& topics, const LogMap& map,
                      const CameraSetup& setup) {
  LogLaser laser;
  laser.scans = openLaserLog(path, topics);
  laser.place = placeScanner(*laser.scans, map, setup);
  return laser;
}

std::optional<RobotMotion> motionInMap(const std::filesystem::path& path,
                                       const RecordingParams& opening) {
  RecordingParams in_map = opening;
  in_map.topics.world_frame = kMapFrame;
  auto motion = openRecording(path, in_map)->readMotion();
  if (motion && motion->frame_id != kMapFrame) motion.reset();
  return motion;
}

std::optional<FloorPose> startOnMap(const LogMap& map, const std::optional<RobotMotion>& in_map,
                                    const LaserReading& first, const CameraSetup& setup) {
  if (map.start) return map.start;
  const auto pose = in_map ? in_map->poses.at(first.stamp_s) : std::nullopt;
  if (!pose) return first.reference;
  return onFloor(in_map->of_camera ? *pose * setup.T_base_camera.inverse() : *pose);
}

RobotPlaces::RobotPlaces(const Recording& recording, const CameraSetup& setup) : setup_(setup) {
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

std::vector<std::string> RobotPlaces::putOnMap(const std::filesystem::path& path,
                                               const RecordingParams& opening, const LogMap& map) {
  in_map_ = motionInMap(path, opening);
  on_map_ = true;
  map_ = map;
  LogLaser laser;
  try {
    laser = openLogLaser(path, opening.topics, map, setup_);
  } catch (const std::runtime_error& error) {
    if (!in_map_) {
      throw std::runtime_error(std::string(error.what()) +
                               "; a robot is found on a map by laser scans and odometry, or by "
                               "tf's frame 'map'");
    }
    motion_ = *in_map_;
    are_known_ = true;
    T_world_motion_ = Eigen::Isometry3d::Identity();
    return {};
  }
  scans_ = std::move(laser.scans);
  localization_ =
      std::make_unique<Localization>(map.walls->floorGrid(HeightBand::around(laser.place.height_m)),
                                     laser.place.T_base_scanner, map.localization);
  has_scan_ = scans_->next(scan_);
  return laser.place.warnings;
}

std::string RobotPlaces::frame() const {
  if (on_map_) return kMapFrame;
  return leaves_s_ ? motion_.frame_id : std::string();
}

std::optional<FloorPose> RobotPlaces::odometryAt(double stamp_s) {
  if (!leaves_s_ && !(on_map_ && !scans_)) return FloorPose();
  const auto pose = motion_.poses.at(stamp_s);
  if (!pose) return std::nullopt;
  const Eigen::Isometry3d T_motion_base =
      motion_.of_camera ? *pose * setup_.T_base_camera.inverse() : *pose;
  if (!T_world_motion_) T_world_motion_ = T_motion_base.inverse();
  const Eigen::Isometry3d T = *T_world_motion_ * T_motion_base;
  if (!first_height_m_) first_height_m_ = T.translation().z();
  greatest_rise_m_ = std::max(greatest_rise_m_, std::abs(T.translation().z() - *first_height_m_));
  greatest_tilt_rad_ = std::max(greatest_tilt_rad_, std::acos(std::clamp(T(2, 2), -1.0, 1.0)));
  return onFloor(T);
}

std::optional<RobotPlace> RobotPlaces::at(double stamp_s,
                                          const std::vector<Eigen::Vector2d>& people) {
  if (scans_) takeScans(stamp_s, people);
  const auto odometry = odometryAt(stamp_s);
  if (!odometry) {
    is_lost_ = false;
    why_absent_ = "the odometry has a gap there";
    return std::nullopt;
  }
  if (!scans_) return RobotPlace{*odometry};
  const LocalizationEstimate& estimate = localization_->estimate();
  if (!scan_odometry_ || estimate.lost) {
    is_lost_ = true;
    why_absent_ = "the robot is not found on the map there (--robot-start tells where it begins)";
    return std::nullopt;
  }
  return RobotPlace{estimate.pose * (scan_odometry_->inverse() * *odometry),
                    estimate.covariance.topLeftCorner<2, 2>()};
}

// As the follower does: beams that end on people are left out.
void RobotPlaces::takeScans(double until_s, const std::vector<Eigen::Vector2d>& people) {
  static const double radius_m = FollowerParams().target_radius_m;
  for (; has_scan_ && scan_.stamp_s <= until_s + kSameTime_s; has_scan_ = scans_->next(scan_)) {
    const auto odometry = odometryAt(scan_.stamp_s);
    if (!odometry) continue;
    if (scan_odometry_) {
      localization_->predict(scan_odometry_->inverse() * *odometry);
    } else {
      const auto start = startOnMap(map_, in_map_, scan_, setup_);
      if (start) localization_->startAt(*start);
    }
    scan_odometry_ = odometry;
    masked_.clear();
    const FloorPose T_base_map = localization_->estimate().pose.inverse();
    for (const Eigen::Vector2d& place : people) masked_.push_back({T_base_map * place, radius_m});
    localization_->update(scan_.scan, masked_);
  }
}

std::string RobotPlaces::warning() const {
  constexpr double kTilt_rad = 0.05, kRise_m = 0.05;  // 15 and 5 cm at 3 m
  if (leaves_s_ && (greatest_tilt_rad_ > kTilt_rad || greatest_rise_m_ > kRise_m)) {
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
