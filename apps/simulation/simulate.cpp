// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/run_end.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/simulation/recording_writer.hpp>
#include <heel/apps/simulation/simulate.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

constexpr double kPace_s = 0.01;
constexpr double kLongest_s = 1e6;  // eleven days

/// A pose in the decimals that odometry.csv has: the bag tells the same.
FloorPose asInTables(const FloorPose& pose) {
  const auto rounded = [](double value, double steps) { return std::round(value * steps) / steps; };
  return {{rounded(pose.position.x(), 1e5), rounded(pose.position.y(), 1e5)},
          rounded(pose.yaw_rad, 1e6)};
}

void addTruth(SensorBag& bag, const Readings& readings) {
  std::vector<FloorPose> people;
  for (const PersonTruth& person : readings.truth.people) {
    people.push_back({person.position, person.yaw_rad});
  }
  bag.addTruth(readings.stamp_s, readings.truth.robot, people);
}

}  // namespace

double stepFor(const RobotParams& robot) {
  const double fastest =
      std::max({robot.camera.rate_hz, robot.laser.rate_hz, robot.odometry.rate_hz});
  const double step = 1.0 / fastest;
  // Sensors whose rates do not divide the fastest one need every tick.
  for (const double rate : {robot.camera.rate_hz, robot.laser.rate_hz, robot.odometry.rate_hz}) {
    const double ratio = fastest / rate, ticks = step / kPace_s;
    if (std::abs(ratio - std::round(ratio)) > 1e-6 || std::abs(ticks - std::round(ticks)) > 1e-6) {
      return kPace_s;
    }
  }
  return step;
}

SensorBag sensorBag(std::unique_ptr<BagWriter> writer, const Simulator& simulator,
                    bool packs_images) {
  RecordingInfo info;
  info.sensor = SensorKind::kStereo;
  info.camera = simulator.camera();
  info.T_base_camera = simulator.T_base_camera();
  SensorBag bag(std::move(writer), info, packs_images);
  const LaserParams& laser = simulator.scene().robot.laser;
  Eigen::Isometry3d T_base_scanner = Eigen::Isometry3d::Identity();
  T_base_scanner.translation() = laser.at;
  bag.setScanner(T_base_scanner, static_cast<float>(laser.max_range_m));
  return bag;
}

void addTo(SensorBag& bag, const Readings& readings) {
  if (readings.odometry) bag.addOdometry(readings.stamp_s, *readings.odometry);
  if (readings.laser != nullptr) bag.add(readings.stamp_s, *readings.laser);
  if (readings.floor_depth_m != nullptr) bag.addFloor(readings.stamp_s, *readings.floor_depth_m);
  if (readings.stereo == nullptr) return;
  Frame frame;
  frame.stamp_s = readings.stamp_s;
  frame.image_bgr = readings.stereo->left_bgr;
  frame.right_bgr = readings.stereo->right_bgr;
  bag.add(frame);
}

SimulateResult simulate(const Scene& scene, const SimulateOptions& options) {
  SimulateResult result;
  result.duration_s = options.duration_s.value_or(scene.duration_s);
  if (!(result.duration_s > 0.0 && result.duration_s <= kLongest_s)) {
    throw std::invalid_argument("--duration must be above 0, and " +
                                std::to_string(static_cast<long>(kLongest_s)) + " s at most");
  }
  Simulator simulator(scene, {options.seed, options.threads, true});
  RecordingWriter writer(options.out, simulator);
  std::optional<SensorBag> bag;
  if (!options.bag.empty()) {
    bag.emplace(sensorBag(createBag(BagPlan{options.bag, {}, "simulate"}), simulator));
  }
  const double step_s = stepFor(scene.robot);
  const auto steps = std::lround(std::ceil(result.duration_s / step_s - 1e-6));
  Readings readings;
  VelocityCommand command;
  for (long i = 0; i < steps; ++i) {
    if (isStopRequested()) {
      result.complete = false;
      result.duration_s = static_cast<double>(i) * step_s;
      break;
    }
    readings = simulator.step(i == 0 ? 0.0 : step_s, command);
    if (readings.odometry) readings.odometry = asInTables(*readings.odometry);
    if (options.drive) command = options.drive(readings.truth);
    writer.add(readings);
    if (bag) {
      addTruth(*bag, readings);
      addTo(*bag, readings);
    }
    if (options.progress) options.progress(static_cast<double>(i + 1) / static_cast<double>(steps));
  }
  result.frames = writer.frames();
  if (result.frames == 0 && !result.complete) return result;
  if (bag) bag->commit(result.complete);
  writer.finish(result.complete);
  return result;
}

}  // namespace heel
