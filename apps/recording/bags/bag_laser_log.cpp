// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// As REP 117 has it: no echo is +inf; -inf, what is too near, and NaN could not be measured. Where
/// there is no echo many small scanners tell 0 (TurtleBot3's, say), and others the greatest range,
/// which some leave at 0.
void markUnknown(const LaserScanMsg& message, std::vector<float>& ranges_m) {
  const float most_m = message.range_max > 0.0F ? message.range_max : kNothing;
  for (float& range_m : ranges_m) {
    if (range_m >= most_m || range_m == 0.0F) {
      range_m = kNothing;
    } else if (!(range_m >= message.range_min)) {
      range_m = kUnknown;
    }
  }
}

/// Beams in the order in which their angles grow.
void turnLeft(LaserScan& scan) {
  if (!(scan.step_rad < 0.0)) return;
  scan.first_rad = scan.angle(std::max<std::size_t>(scan.ranges_m.size(), 1) - 1);
  scan.step_rad = -scan.step_rad;
  std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
}

/// Angles in [-pi, pi): beams from pi on come first. Of a scan that is no full circle there is a
/// gap then, in which nothing is known; of one that goes round further, its end is left out.
void putInOneTurn(LaserScan& scan) {
  constexpr double kTurn_rad = 2.0 * M_PI;
  constexpr double kMostBeams = 1e5;  // in a turn: no scanner has more
  std::vector<float>& ranges_m = scan.ranges_m;
  const double beams = std::round(kTurn_rad / scan.step_rad);
  if (!std::isfinite(scan.first_rad) || !(beams >= 1.0 && beams <= kMostBeams)) return;
  const double rounding_rad = 1e-3 * scan.step_rad;  // angles are told as floats
  scan.first_rad -= kTurn_rad * std::floor((scan.first_rad + M_PI + rounding_rad) / kTurn_rad);
  const auto turn = static_cast<std::size_t>(beams);
  if (ranges_m.size() > turn) ranges_m.resize(turn);
  const auto within =
      static_cast<std::size_t>(std::ceil((M_PI - rounding_rad - scan.first_rad) / scan.step_rad));
  if (within >= ranges_m.size()) return;
  ranges_m.resize(turn, kUnknown);
  std::rotate(ranges_m.begin(), ranges_m.begin() + static_cast<std::ptrdiff_t>(within),
              ranges_m.end());
  scan.first_rad = scan.angle(within) - kTurn_rad;
}

/// Which of several lasers is read, in a sentence; empty if there is one, or it is named.
std::string severalScans(const BagSurvey& survey, const BagTopics& topics,
                         const BagTopicSummary& read) {
  std::vector<std::string> names;
  for (const BagTopicSummary& t : survey.topics) {
    if (t.topic.holds<LaserScanMsg>() && t.count > 0) names.push_back(t.topic.name);
  }
  if (names.size() < 2 || !topics.scan.empty()) return {};
  return severalNote(survey, "topics of laser scans", read.topic.name, names,
                     "--scan-topic reads another");
}

}  // namespace

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
  for (const std::string& several :
       {severalScans(survey, topics, *scans), severalOdometries(survey, topics)}) {
    if (!several.empty()) warnings_.push_back(several);
  }
  scan_topic_ = scans->topic.name;
  has_stamps_ = scans->has_stamps;
  lost_ = survey.lost;
  place(survey, topics, scans->frame_id);
  std::vector<std::string> read = poses_->topics();
  read.push_back(scan_topic_);
  bag_->select(survey.queryOf(std::move(read), true));
}

void BagLaserLog::place(const BagSurvey& survey, const BagTopics& topics,
                        const std::string& frame) {
  const auto on_robot = placeOnRobot(survey, topics, frame);
  if (!on_robot) {
    unplaced_ = survey.path.string() + ": tf does not join '" + frame +
                "' to base_footprint or base_link (its root is '" + survey.rootOf(frame) +
                "'): use --base-frame or --scanner";
    return;
  }
  const Eigen::Isometry3d& T = *on_robot;
  T_base_scanner_ = FloorPose{T.translation().head<2>(), std::atan2(T(1, 0), T(0, 0))};
  scanner_height_m_ = T.translation().z();
  is_upside_down_ = T(2, 2) < 0.0;
  constexpr double kLevel = 0.9;  // the cosine of 26 degrees
  if (std::abs(T(2, 2)) >= kLevel) return;
  warnings_.push_back(survey.path.string() + ": by tf the laser '" + frame + "' is tilted by " +
                      std::to_string(std::lround(std::acos(std::abs(T(2, 2))) * 180.0 / M_PI)) +
                      " degrees; its scans are taken as level");
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
    const double sign = is_upside_down_ ? -1.0 : 1.0;
    reading.scan.first_rad = sign * scan_.angle_min;
    reading.scan.step_rad = sign * scan_.angle_increment;
    reading.scan.ranges_m = scan_.ranges;
    markUnknown(scan_, reading.scan.ranges_m);
    turnLeft(reading.scan);
    putInOneTurn(reading.scan);
    return true;
  }
  return false;
}

}  // namespace heel
