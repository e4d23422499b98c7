// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

BagLaserLog::BagLaserLog(const std::filesystem::path& path, const BagTopics& topics)
    : BagLaserLog(surveyBag(path), openBag(path), topics) {}

BagLaserLog::BagLaserLog(const BagSurvey& survey, std::unique_ptr<BagReader> reader,
                         const BagTopics& topics)
    : bag_(std::move(reader)) {
  const BagTopicSummary* scans =
      findBagTopic<LaserScanMsg>(survey, topics.scan, {"base_scan", "scan_front", "scan"});
  if (scans == nullptr) failWithTopics(survey, "has no laser scans");
  poses_.emplace(survey, topics);
  if (!poses_->hasOdometry()) failWithTopics(survey, "has laser scans, but no odometry");
  scan_topic_ = scans->topic.name;
  has_stamps_ = scans->has_stamps;
  lost_ = survey.lost;
  if (const auto place = placeOnRobot(survey, topics, scans->frame_id)) {
    const Eigen::Isometry3d& T = *place;
    T_base_scanner_ = FloorPose{T.translation().head<2>(), std::atan2(T(1, 0), T(0, 0))};
    scanner_height_m_ = T.translation().z();
  }
  std::vector<std::string> read = poses_->topics();
  read.push_back(scan_topic_);
  bag_->select(survey.queryOf(std::move(read), true));
}

bool BagLaserLog::next(LaserReading& reading) {
  BagMessage raw;
  while (bag_->next(raw)) {
    if (bag_->topics()[raw.topic].name != scan_topic_) {
      poses_->take(*bag_, raw);
      continue;
    }
    try {
      bag_->read(raw, scan_);
    } catch (const std::runtime_error&) {
      continue;
    }
    reading.stamp_s = secondsOf(has_stamps_ ? scan_.header.stamp.ns : raw.stamp_ns);
    const auto odometry = poses_->odometryAt(reading.stamp_s);
    if (!odometry) continue;  // before the first one
    reading.odometry = *odometry;
    reading.reference = poses_->truthAt(reading.stamp_s);
    reading.scan.first_rad = scan_.angle_min;
    reading.scan.step_rad = scan_.angle_increment;
    reading.scan.ranges_m = scan_.ranges;
    for (float& range : reading.scan.ranges_m) {
      const bool is_valid = range >= scan_.range_min && range <= scan_.range_max;
      if (!is_valid) range = std::numeric_limits<float>::infinity();
    }
    return true;
  }
  return false;
}

}  // namespace heel
