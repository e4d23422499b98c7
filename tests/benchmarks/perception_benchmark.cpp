// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The whole perception step, from images to the target's place, against cv::StereoSGBM alone on
/// the same pair: 640x480, one thread. `percent` counts the pixels of the target's colours.

#include "tests/benchmarks/against_dense.hpp"
#include "tests/support/target_scene.hpp"
#include <heel/apps/follower/perception.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <string>

namespace {

using namespace heel;

const test::TargetScene& scene() {
  static const test::TargetScene rendered = test::targetScene();
  return rendered;
}

/// Steps through the same frame again and again; reports each stage's time.
void perceptionStep(benchmark::State& state, SensorKind sensor) {
  CameraSetup setup;
  setup.sensor = sensor;
  setup.camera = scene().camera;
  setup.T_base_camera = scene().T_base_camera;
  Perception perception(setup, test::modelOf(scene()));
  Frame frame;
  frame.image_bgr = scene().pair.left;
  frame.right_bgr = scene().pair.right;
  frame.depth_m = scene().depth_m;
  std::array<double, kStages> stage_s{};
  const PerceptionStep* last = nullptr;
  double stage_began = 0.0;
  const Perception::StageDone stage_done = [&](Stage stage) {
    const double now = test::cpuSeconds();
    stage_s[static_cast<std::size_t>(stage)] += now - stage_began;
    stage_began = now;
  };
  int frames = 0;
  test::againstDense(state, test::OpenCvMatcher(frame.image_bgr, frame.right_bgr), [&] {
    frame.stamp_s += 0.1;
    ++frames;
    stage_began = test::cpuSeconds();
    last = &perception.step(frame, {}, nullptr, stage_done);
  });
  if (!last->target.hasPlace()) {
    state.SkipWithError(last->reason.c_str());
    return;
  }
  const double off_m = (last->target.motion.position_m() - scene().place_m).norm();
  if (off_m > 0.2) {
    state.SkipWithError("something else was taken for the target");
    return;
  }
  state.counters["percent"] = 100.0 * last->color_pixels / static_cast<double>(last->mask.total());
  state.counters["blobs"] = static_cast<double>(last->blobs.size());
  state.counters["off_m"] = off_m;
  for (int i = 0; i < kStages; ++i) {
    const std::string name = toText(static_cast<Stage>(i));
    state.counters[name + "_ms"] = 1e3 * stage_s[static_cast<std::size_t>(i)] / frames;
  }
}

void PerceptionOfStereo(benchmark::State& state) { perceptionStep(state, SensorKind::kStereo); }
BENCHMARK(PerceptionOfStereo)->UseManualTime()->Unit(benchmark::kMillisecond);

void PerceptionOfRgbd(benchmark::State& state) { perceptionStep(state, SensorKind::kRgbd); }
BENCHMARK(PerceptionOfRgbd)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
