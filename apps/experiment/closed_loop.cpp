// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/scene_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kReached_s = 1.0;
constexpr int kPerson = 0;  // The scene's first person is the one to follow.

void addTruth(const Readings& readings, FollowSample& sample) {
  sample.stamp_s = readings.stamp_s;
  sample.robot_true = readings.truth.robot;
  sample.speed_true = readings.truth.robot_speed;
  const PersonTruth& person = readings.truth.people[kPerson];
  sample.person_true = person.position;
  for (std::size_t i = 1; i < readings.truth.people.size(); ++i) {
    sample.others_true.push_back(readings.truth.people[i].position);
  }
  sample.person_distance_m = (person.position - readings.truth.robot.position).norm();
  sample.clearance_m = std::max(readings.truth.clearance_m, 0.0);
  sample.contact = readings.truth.contact;
  sample.contact_by_robot = readings.truth.contact_by_robot;
  if (!sample.target_estimate) return;
  sample.wrong_person =
      isWrongPerson(*sample.target_estimate, sample.person_true, sample.others_true);
}

}  // namespace

RobotDescription describeRobot(const RobotParams& params) {
  RobotDescription robot;
  robot.drive = params.drive;
  robot.height_m = params.height_m;
  robot.T_base_scanner.position = params.laser.at.head<2>();
  robot.scanner_height_m = params.laser.at.z();
  robot.scan_latency_s = params.laser.latency_s;
  robot.wheels_latency_s = params.wheels_latency_s;
  if (params.floor_camera) {
    CameraSetup& floor = robot.floor_camera.emplace();
    floor.sensor = SensorKind::kRgbd;
    floor.camera.left = pinholeOf(*params.floor_camera);
    floor.T_base_camera = mountedCamera(params.floor_camera->at, params.floor_camera->pitch_rad);
    floor.is_configured = true;
  }
  return robot;
}

FollowSample sampleOf(const FollowStep& step, const Follower& follower) {
  FollowSample sample;
  sample.stamp_s = step.stamp_s;
  sample.robot_estimated = step.robot.pose;
  sample.position_sigma_m = std::sqrt(step.robot.covariance.topLeftCorner<2, 2>().trace() / 2.0);
  sample.is_localized = !step.robot.lost;
  sample.command = step.velocity;
  sample.state = step.state();
  sample.reason = step.reason;
  if (follower.perception() != nullptr) {
    sample.target_status = toText(follower.target().status);
    sample.confidence = follower.target().confidence;
  }
  if (step.perception != nullptr && !step.perception->mask.empty()) {
    sample.candidate_share =
        step.perception->color_pixels / static_cast<double>(step.perception->mask.total());
  }
  sample.robot_true = step.robot.pose;
  sample.speed_true = step.velocity;
  if (step.target && !step.is_learning) {
    sample.target_estimate = step.target;
    sample.person_distance_m = (*step.target - step.robot.pose.position).norm();
  }
  return sample;
}

Readings shownOf(const RobotReadings& readings, StereoReading& picture) {
  Readings shown;
  shown.stamp_s = readings.stamp_s;
  if (readings.frame != nullptr && !readings.frame->image_bgr.empty()) {
    picture.left_bgr = readings.frame->image_bgr;
    shown.stereo = &picture;
  }
  return shown;
}

const char* outcomeOf(PlanOutcome outcome) {
  return outcome == PlanOutcome::kFailed ? "failed" : "done";
}

FollowLog runClosedLoop(const Scene& scene, const PetriPlan& plan, const ClosedLoopParams& params,
                        const LoopObserver& observer, const Follower::StageDone& stage_done) {
  if (scene.people.empty()) throw std::runtime_error(scene.name + ": there is nobody to follow");
  SimulatorOptions options;
  options.seed = params.seed;
  options.threads = params.threads;
  Latencies latencies = latenciesOf(params.rough, params.seed);
  latencies.laser_s = std::max(latencies.laser_s, scene.robot.laser.latency_s);
  latencies.wheels_s = std::max(latencies.wheels_s, scene.robot.wheels_latency_s);
  options.wheels_latency_s = latencies.wheels_s;
  Simulator simulator(roughened(scene, params.rough, params.seed), options);
  RobotDescription robot = describeRobot(simulator.scene().robot);
  robot.camera.sensor = SensorKind::kStereo;
  robot.camera.camera = simulator.camera();
  robot.camera.T_base_camera = simulator.T_base_camera();
  robot.camera.is_configured = true;
  robot.drive.period_s = params.period_s;
  robot.scan_latency_s = latencies.laser_s;
  robot.wheels_latency_s = latencies.wheels_s;
  std::shared_ptr<const WallMap> map;
  if (params.has_map) {
    map = std::make_shared<WallMap>(wallMapOf(asMapped(scene, params.rough, params.seed)));
  }
  Follower follower(robot, std::move(map), plan,
                    FloorPose{scene.robot.start, scene.robot.start_yaw_rad}, params.follower);
  std::vector<Fault> faults = dropoutsOf(params.rough, params.limit_s, params.seed);
  faults.insert(faults.end(), params.faults.begin(), params.faults.end());
  FaultySensors sensors(std::move(faults), params.seed, latencies);

  FollowLog log;
  log.scene = scene.name;
  log.seed = params.seed;
  log.plan = plan.net.name;
  log.person = scene.people[kPerson].name;
  log.map = follower.floor();
  log.drive = robot.drive;
  log.camera_rate_hz = scene.robot.camera.rate_hz;
  log.outcome = "timeout";
  // At once, for an hour at most: a list that outgrows its memory again and again leaves holes.
  const double steps = std::min(params.limit_s, kHour_s) / params.period_s;
  log.samples.reserve(static_cast<std::size_t>(steps) + 2);
  double with_person_s = 0.0;
  VelocityCommand command;
  for (double dt_s = 0.0;; dt_s = params.period_s) {
    const Readings& readings = simulator.step(dt_s, command);
    const FollowStep* step = nullptr;
    try {
      step = &follower.step(sensors.read(readings), stage_done);
    } catch (const NobodyLearned&) {
      log.outcome = kNobodyLearned;
      break;
    }
    command = step->velocity;
    FollowSample& sample = log.samples.emplace_back(sampleOf(*step, follower));
    addTruth(readings, sample);
    if (observer) observer(readings, *step, follower, sample);

    const bool with_person = readings.truth.people[kPerson].is_done && sample.target_estimate &&
                             !sample.wrong_person && sample.person_distance_m < kReached_m;
    with_person_s = with_person ? with_person_s + params.period_s : 0.0;
    if (with_person_s > kReached_s) {
      log.outcome = "reached";
      break;
    }
    if (step->outcome != PlanOutcome::kRunning) {
      log.outcome = outcomeOf(step->outcome);
      break;
    }
    if (isStopRequested()) {
      log.outcome = kStoppedRun;
      break;
    }
    if (readings.stamp_s >= params.limit_s) break;
  }
  return log;
}

}  // namespace heel
