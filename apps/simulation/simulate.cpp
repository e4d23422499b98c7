// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/simulate.hpp"

#include "apps/simulation/recording_writer.hpp"

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

constexpr double kTick_s = 0.01;

/// The longest step, in whole ticks, that skips no measurement of any sensor.
double stepFor(const RobotParams& robot) {
  const double fastest =
      std::max({robot.camera.rate_hz, robot.laser.rate_hz, robot.odometry.rate_hz});
  const double step = 1.0 / fastest;
  // Sensors whose rates do not divide the fastest one need every tick.
  for (const double rate : {robot.camera.rate_hz, robot.laser.rate_hz, robot.odometry.rate_hz}) {
    const double ratio = fastest / rate, ticks = step / kTick_s;
    if (std::abs(ratio - std::round(ratio)) > 1e-6 || std::abs(ticks - std::round(ticks)) > 1e-6) {
      return kTick_s;
    }
  }
  return step;
}

}  // namespace

SimulateResult simulate(const Scene& scene, const SimulateOptions& options) {
  Simulator simulator(scene, {options.seed, options.threads, true});
  RecordingWriter writer(options.out, simulator, options.write_pixel_truth);
  SimulateResult result;
  result.duration_s = options.duration_s.value_or(scene.duration_s);
  const double step_s = stepFor(scene.robot);
  const auto steps = std::lround(std::ceil(result.duration_s / step_s - 1e-6));
  for (long i = 0; i < steps; ++i) {
    writer.add(simulator.step(i == 0 ? 0.0 : step_s));
    if (options.progress) options.progress(static_cast<double>(i + 1) / static_cast<double>(steps));
  }
  writer.finish();
  result.frames = writer.frames();
  return result;
}

}  // namespace heel
