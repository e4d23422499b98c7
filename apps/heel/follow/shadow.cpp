// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/follow/shadow.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

/// The readings of a log in the order of time.
class LogReadings {
 public:
  LogReadings(std::unique_ptr<Recording> recording, std::unique_ptr<LaserLog> scans,
              RobotPlaces odometry)
      : recording_(std::move(recording)),
        scans_(std::move(scans)),
        odometry_(std::move(odometry)),
        has_frame_(recording_->next(next_frame_)),
        has_scan_(scans_->next(next_scan_)) {
    // What is before the first frame is not of the part that is read.
    while (has_frame_ && has_scan_ && next_scan_.stamp_s < next_frame_.stamp_s - kSameTime_s) {
      has_scan_ = scans_->next(next_scan_);
    }
  }

  const Recording& recording() const { return *recording_; }
  /// The next that comes.
  const LaserReading& nextScan() const { return next_scan_; }
  const std::optional<FloorPose>& reference() const { return reference_; }
  const Frame& frame() const { return frame_; }

  /// What was measured at the next moment; false if there are no more frames.
  bool next(RobotReadings& readings) {
    if (!has_frame_) return false;
    const double scan_s = has_scan_ ? next_scan_.stamp_s : std::numeric_limits<double>::infinity();
    const double now_s = std::min(next_frame_.stamp_s, scan_s);
    readings = {};
    readings.stamp_s = now_s;
    if (next_frame_.stamp_s <= now_s + kSameTime_s) {
      std::swap(frame_, next_frame_);
      readings.frame = &frame_;
      has_frame_ = recording_->next(next_frame_);
    }
    if (scan_s <= now_s + kSameTime_s) {
      std::swap(scan_, next_scan_);
      readings.scan = &scan_.scan;
      reference_ = scan_.reference;
      has_scan_ = scans_->next(next_scan_);
    }
    if (const auto place = odometry_.at(now_s)) readings.odometry = place->pose;
    return true;
  }

 private:
  std::unique_ptr<Recording> recording_;
  std::unique_ptr<LaserLog> scans_;
  RobotPlaces odometry_;
  Frame frame_, next_frame_;
  LaserReading scan_, next_scan_;
  bool has_frame_, has_scan_;
  std::optional<FloorPose> reference_;
};

/// What the robot did, by its odometry.
class DrivenSpeed {
 public:
  VelocityCommand at(const RobotReadings& readings) {
    if (!readings.odometry) return speed_;
    const double in_s = readings.stamp_s - stamp_s_;
    if (last_ && in_s < kLeast_s) return speed_;
    if (last_) {
      const FloorPose moved = last_->inverse() * *readings.odometry;
      speed_ = {moved.position.x() / in_s, moved.yaw_rad / in_s};
    }
    last_ = readings.odometry;
    stamp_s_ = readings.stamp_s;
    return speed_;
  }

 private:
  // From one command to the next: over less, the noise of odometry is most of it.
  static constexpr double kLeast_s = DriveLimits().period_s - kSameTime_s;
  std::optional<FloorPose> last_;
  double stamp_s_ = 0.0;
  VelocityCommand speed_;
};

Follower makeFollower(const ShadowParams& params, const PetriPlan& plan, const CameraSetup& setup,
                      const LogLaser& laser, const LaserReading& first,
                      const std::optional<FloorPose>& odometry) {
  RobotDescription robot = describeRobot(params.config.robot);
  robot.camera = setup;
  robot.floor_camera.reset();  // No log has its images.
  robot.T_base_scanner = laser.place.T_base_scanner;
  robot.scanner_height_m = laser.place.height_m;
  const auto start = [&]() -> std::optional<FloorPose> {
    if (!params.map.walls) return odometry;
    const auto in_map = motionInMap(params.recording, params.opening);
    return startOnMap(params.map, in_map, first, setup);
  };
  return Follower(robot, params.map.walls, plan, start(), params.config.follow);
}

}  // namespace

FollowLog runShadow(const ShadowParams& params, const PetriPlan& plan, const LoopObserver& observer,
                    const Follower::StageDone& stage_done) {
  const auto open = [&] { return openRecording(params.recording, params.opening); };
  const CameraSetup setup = findCameraSetup(*open(), params.config.camera_setup);
  for (const std::string& warning : setup.warnings) warn(warning);
  auto recording = open();
  RobotPlaces odometry(*recording, setup);
  std::optional<FloorPose> first_place;
  if (const auto place = odometry.at(recording->info().first_s)) first_place = place->pose;
  LogLaser laser = openLogLaser(params.recording, params.opening.topics, params.map, setup);
  for (const std::string& warning : laser.place.warnings) warn(warning);
  LogReadings readings(std::move(recording), std::move(laser.scans), std::move(odometry));
  Follower follower = makeFollower(params, plan, setup, laser, readings.nextScan(), first_place);
  if (params.model) follower.skipLearning(*params.model);

  FollowLog log;
  const RecordingInfo& info = readings.recording().info();
  log.scene = info.name;
  log.plan = plan.net.name;
  log.map = follower.floor();
  log.drive = follower.robot().drive;
  if (info.duration_s > 0.0) {
    log.camera_rate_hz = static_cast<double>(info.frame_count) / info.duration_s;
  }
  log.is_shadow = true;
  log.outcome = "end of log";
  ProgressBar progress("following", static_cast<std::size_t>(info.duration_s));
  DrivenSpeed driven;
  RobotReadings now;
  StereoReading picture;
  while (readings.next(now)) {
    if (isStopRequested()) {
      log.outcome = kStoppedRun;
      break;
    }
    const FollowStep* step = nullptr;
    try {
      step = &follower.step(now, stage_done);
    } catch (const NobodyLearned&) {
      log.outcome = kNobodyLearned;
      break;
    }
    FollowSample& sample = log.samples.emplace_back(sampleOf(*step, follower));
    if (params.map.walls && readings.reference()) sample.robot_true = *readings.reference();
    sample.speed_true = driven.at(now);
    if (observer) observer(shownOf(now, picture), *step, follower, sample);
    if (step->outcome != PlanOutcome::kRunning) {
      log.outcome = outcomeOf(step->outcome);
      break;
    }
    const double elapsed_s = now.stamp_s - log.samples.front().stamp_s;
    progress.show(static_cast<std::size_t>(elapsed_s));
    if (elapsed_s >= params.limit_s) {
      log.outcome = "timeout";
      break;
    }
  }
  for (const SkippedFrame& skipped : readings.recording().skipped()) warn(skipped.reason);
  if (log.samples.empty()) throw std::runtime_error(nothingReadMessage(readings.recording()));
  const auto lost = std::count_if(log.samples.begin(), log.samples.end(),
                                  [](const FollowSample& s) { return !s.is_localized; });
  if (params.map.walls && 2 * lost > static_cast<std::ptrdiff_t>(log.samples.size())) {
    warn(
        "the robot does not know where it is on the map for most of the log, and so stands "
        "(--robot-start tells where it is at first)");
  }
  return log;
}

}  // namespace heel
