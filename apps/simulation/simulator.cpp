// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/simulator.hpp>

#include <tbb/info.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kTick_s = 0.01;
constexpr int kTicksPerStride = 2;    // People decide where to step every other tick.
constexpr double kMoves_mps = 0.02;   // Slower is no move of the robot's towards somebody.
constexpr double kStepsOver_m = 0.2;  // So high a thing people step over.

/// Counts the measurements that a sensor should have made.
class SensorClock {
 public:
  explicit SensorClock(double rate_hz) : rate_hz_(rate_hz) {}

  /// Whether a measurement is due, at most one a call.
  bool due(double time_s) {
    const auto count = static_cast<std::int64_t>(std::floor(time_s * rate_hz_ + 1e-6));
    if (count == count_) return false;
    count_ = count;
    return true;
  }
  std::uint64_t count() const { return static_cast<std::uint64_t>(count_); }

 private:
  double rate_hz_;
  std::int64_t count_ = -1;
};

}  // namespace

struct Simulator::State {
  State(Scene scene_in, const SimulatorOptions& options_in)
      : scene(std::move(scene_in)),
        options(options_in),
        arena(options.threads > 0 ? std::min(options.threads, tbb::info::default_concurrency())
                                  : tbb::task_arena::automatic),
        plan(scene, false, kDrivesOver_m, scene.robot.height_m),
        walkers_plan(scene, false, kStepsOver_m),
        hiding(scene, false, scene.robot.height_m),
        geometry(makeGeometry(scene)),
        world(geometry),
        robot(scene.robot),
        odometry(scene.robot.odometry, hashOf(options.seed, 1)),
        camera_clock(scene.robot.camera.rate_hz),
        laser_clock(scene.robot.laser.rate_hz),
        odometry_clock(scene.robot.odometry.rate_hz) {
    if (scene.robot.floor_camera) floor_clock.emplace(scene.robot.floor_camera->rate_hz);
    walkers.reserve(scene.people.size());
    for (const ScenePerson& person : scene.people) walkers.emplace_back(person);
    if (!options.render) return;
    arena.execute([this] { lights = std::make_unique<LightMap>(scene, geometry, world); });
    shader = std::make_unique<Shader>(scene, geometry, world, *lights);
    if (scene.robot.camera.drawn_light) {
      light.emplace(hashOf(options.seed, 5));
    }
    camera_model = std::make_unique<CameraModel>(scene.robot.camera, hashOf(options.seed, 2),
                                                 light ? light->gamma() : 1.0);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void tick();
  void placeBodies();
  void render();
  void tellTruth();
  double clearance(const FloorPose& pose) const;
  double roomTo(const Mover& mover, const FloorPose& pose) const;
  bool isDrivenInto(const FloorPose& from, const FloorPose& to) const;
  void give(const VelocityCommand& command);

  Scene scene;
  SimulatorOptions options;
  tbb::task_arena arena;
  FloorPlan plan, walkers_plan, hiding;
  Geometry geometry;
  RayWorld world;
  std::unique_ptr<LightMap> lights;
  std::unique_ptr<Shader> shader;
  std::unique_ptr<CameraModel> camera_model;
  std::optional<DrawnLight> light;
  std::vector<Walker> walkers;
  DriveBase robot;
  WheelOdometry odometry;
  SensorClock camera_clock, laser_clock, odometry_clock;
  std::optional<SensorClock> floor_clock;
  std::int64_t ticks = 0;
  struct Given {
    std::int64_t acts = 0;  // at this tick
    VelocityCommand command;
  };
  std::deque<Given> given;
  VelocityCommand obeyed;
  Readings readings;
  StereoReading stereo;
  LaserScan scan;
  cv::Mat floor_depth_m;
  RenderedView left, right;
};

double Simulator::State::clearance(const FloorPose& pose) const {
  const DriveLimits& drive = scene.robot.drive;
  double least =
      roomAround(drive, pose, [&](const Eigen::Vector2d& p) { return plan.clearance(p); });
  for (const Walker& walker : walkers) least = std::min(least, roomTo(walker.mover(), pose));
  return least;
}

double Simulator::State::roomTo(const Mover& mover, const FloorPose& pose) const {
  const Eigen::Vector2d near = axisOf(scene.robot.drive, pose).nearest(mover.position);
  return (mover.position - near).norm() - mover.radius_m - scene.robot.drive.radius_m;
}

/// Whether the robot, on its way from one pose to another, moves towards what it touches there.
bool Simulator::State::isDrivenInto(const FloorPose& from, const FloorPose& to) const {
  const auto things = [&](const Eigen::Vector2d& p) { return plan.clearance(p); };
  if (roomAround(scene.robot.drive, to, things) < 0.0) return true;
  return std::any_of(walkers.begin(), walkers.end(), [&](const Walker& walker) {
    const double after_m = roomTo(walker.mover(), to);
    return after_m < 0.0 && roomTo(walker.mover(), from) - after_m > kMoves_mps * kTick_s;
  });
}

// Commands do not overtake each other.
void Simulator::State::give(const VelocityCommand& command) {
  const double share =
      0.5 + 0.5 * uniformFrom(hashOf(options.seed, 6, static_cast<std::uint64_t>(ticks)));
  std::int64_t acts = ticks + std::llround(share * options.wheels_latency_s / kTick_s);
  if (!given.empty()) acts = std::max(acts, given.back().acts);
  given.push_back({acts, command});
}

void Simulator::State::tick() {
  while (!given.empty() && given.front().acts <= ticks) {
    obeyed = given.front().command;
    given.pop_front();
  }
  robot.accelerate(kTick_s, obeyed);
  // Something in the way stops the robot, but it may always back out of it.
  if (clearance(robot.ahead(kTick_s)) < 0.0) {
    WorldTruth& truth = readings.truth;
    truth.contact = true;
    truth.contact_by_robot =
        truth.contact_by_robot || isDrivenInto(robot.pose(), robot.ahead(kTick_s));
    const double now_m = clearance(robot.pose());
    const auto isBlocked = [&] {
      const double next_m = clearance(robot.ahead(kTick_s));
      return next_m < 0.0 && next_m < now_m;
    };
    if (isBlocked()) robot.stop(true);
    if (isBlocked()) robot.stop(false);
  }
  robot.go(kTick_s);
  odometry.add(robot.speed().forward_mps * kTick_s, robot.speed().turn_radps * kTick_s);
  ++ticks;
  if (ticks % kTicksPerStride != 0) return;
  const Eigen::Vector2d robot_velocity =
      robot.speed().forward_mps *
      Eigen::Vector2d(std::cos(robot.pose().yaw_rad), std::sin(robot.pose().yaw_rad));
  std::vector<Mover> others;
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    others.clear();
    for (std::size_t j = 0; j < walkers.size(); ++j) {
      if (j != i) others.push_back(walkers[j].mover());
    }
    const DriveLimits& drive = scene.robot.drive;
    others.push_back({axisOf(drive, robot.pose()).nearest(walkers[i].pose().position),
                      robot_velocity, drive.radius_m + kRobotRoom_m});
    walkers[i].step(kTicksPerStride * kTick_s, walkers_plan, hiding, others, others.back());
  }
}

void Simulator::State::placeBodies() {
  std::vector<BodyPart> parts;
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    appendBody(scene.people[i], static_cast<int>(i), walkers[i].pose(), parts);
  }
  world.setPeople(std::move(parts));
  if (shader) shader->peopleHaveMoved();
}

void Simulator::State::render() {
  const CameraParams& params = scene.robot.camera;
  const PinholeCamera pinhole = pinholeOf(params);
  const Eigen::Isometry3d T_world_left =
      basePose(robot.pose()) * mountedCamera(params.at, params.pitch_rad);
  const Eigen::Isometry3d T_world_right =
      T_world_left * Eigen::Translation3d(params.baseline_m, 0.0, 0.0);
  const std::uint64_t picture = hashOf(options.seed, 3, camera_clock.count());
  const float right_gain = 1.0F + 0.03F * static_cast<float>(uniformFrom(options.seed) - 0.5);
  arena.execute([&] {
    tbb::parallel_invoke([&] { renderView(world, *shader, pinhole, T_world_left, left); },
                         [&] { renderView(world, *shader, pinhole, T_world_right, right); });
    CameraLight now;
    if (light) {
      now = light->at(readings.stamp_s, left.radiance, params.exposure,
                      pinhole.fx * robot.speed().turn_radps);
    }
    tbb::parallel_invoke(
        [&] { camera_model->develop(left.radiance, picture, 1.0F, now, stereo.left_bgr); },
        [&] {
          camera_model->develop(right.radiance, picture + 1, right_gain, now, stereo.right_bgr);
        });
  });
  stereo.depth_m = left.depth_m;
  stereo.people = left.people;
  readings.stereo = &stereo;
}

void Simulator::State::tellTruth() {
  WorldTruth& truth = readings.truth;
  truth.robot = robot.pose();
  truth.robot_speed = robot.speed();
  truth.people.resize(walkers.size());
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const Mover mover = walkers[i].mover();
    truth.people[i] = {scene.people[i].name, mover.position, mover.velocity,
                       walkers[i].pose().yaw_rad, walkers[i].done()};
  }
  truth.clearance_m = clearance(robot.pose());
}

Simulator::Simulator(Scene scene, const SimulatorOptions& options)
    : state_(std::make_unique<State>(std::move(scene), options)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

const Readings& Simulator::step(double dt_s, const VelocityCommand& command) {
  State& s = *state_;
  const double wanted_ticks = dt_s / kTick_s;
  if (!(dt_s >= 0.0) || std::abs(wanted_ticks - std::round(wanted_ticks)) > 1e-6) {
    throw std::invalid_argument("Simulator::step: dt_s must be a multiple of 0.01 s");
  }
  s.readings.truth.contact = s.readings.truth.contact_by_robot = false;
  s.give(command);
  for (auto n = std::lround(wanted_ticks); n > 0; --n) s.tick();
  const double now_s = static_cast<double>(s.ticks) * kTick_s;
  s.readings.stamp_s = now_s;
  s.readings.stereo = nullptr;
  s.readings.laser = nullptr;
  s.readings.floor_depth_m = nullptr;
  s.readings.odometry.reset();
  s.tellTruth();
  const bool camera_due = s.camera_clock.due(now_s) && s.options.render;
  const bool laser_due = s.laser_clock.due(now_s);
  const bool floor_due = s.floor_clock && s.floor_clock->due(now_s);
  if (camera_due || laser_due || floor_due) s.placeBodies();
  if (camera_due) s.render();
  if (laser_due) {
    measureLaser(s.world, s.geometry, s.scene.robot.laser, s.robot.pose(),
                 hashOf(s.options.seed, 4, s.laser_clock.count()), s.scan);
    s.readings.laser = &s.scan;
  }
  if (floor_due) {
    measureFloor(s.world, s.geometry, *s.scene.robot.floor_camera, s.robot.pose(),
                 hashOf(s.options.seed, 7, s.floor_clock->count()), s.floor_depth_m);
    s.readings.floor_depth_m = &s.floor_depth_m;
  }
  if (s.odometry_clock.due(now_s)) s.readings.odometry = s.odometry.pose();
  return s.readings;
}

const Scene& Simulator::scene() const { return state_->scene; }

StereoCamera Simulator::camera() const {
  return {pinholeOf(state_->scene.robot.camera), state_->scene.robot.camera.baseline_m, 0.0};
}

Eigen::Isometry3d Simulator::T_base_camera() const {
  const CameraParams& camera = state_->scene.robot.camera;
  return mountedCamera(camera.at, camera.pitch_rad);
}

bool Simulator::everyoneIsDone() const {
  return std::all_of(state_->walkers.begin(), state_->walkers.end(),
                     [](const Walker& walker) { return walker.done(); });
}

}  // namespace heel
