// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// How fast the shipped scenes run: one iteration is a tenth of a second of the world, with a stereo
// pair and a laser scan. `realtime` is how many times faster than the clock that is.

#include <heel/apps/simulation/simulator.hpp>

#include <benchmark/benchmark.h>

#include <string>

namespace heel {
namespace {

void runScene(benchmark::State& state, const std::string& name, int width, int threads) {
  Scene scene = loadScene(std::string(HEEL_SCENES) + "/" + name + ".yaml");
  scene.robot.camera.width = width;
  scene.robot.camera.height = width * 3 / 4;
  SimulatorOptions options;
  options.threads = threads;
  Simulator simulator(scene, options);
  simulator.step(0.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulator.step(0.1, {0.0, 0.1}).stereo->left_bgr.ptr());
  }
  state.counters["realtime"] = benchmark::Counter(0.1 * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate);
}

void BM_Step(benchmark::State& state, const std::string& name) {
  runScene(state, name, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}

void BM_StepWithoutPictures(benchmark::State& state) {
  const Scene scene = loadScene(std::string(HEEL_SCENES) + "/home.yaml");
  Simulator simulator(scene, {1, 1, false});
  for (auto _ : state) benchmark::DoNotOptimize(simulator.step(0.1).laser->ranges_m.data());
}

void BM_Setup(benchmark::State& state) {
  const Scene scene = loadScene(std::string(HEEL_SCENES) + "/home.yaml");
  for (auto _ : state) benchmark::DoNotOptimize(Simulator(scene));
}

// Iterations are set, so that all runs see the same stretch of the scene.
#define HEEL_SCENE(name)                  \
  BENCHMARK_CAPTURE(BM_Step, name, #name) \
      ->ArgNames({"width", "threads"})    \
      ->ArgsProduct({{320, 640}, {1, 2}}) \
      ->Iterations(100)                   \
      ->MeasureProcessCPUTime()           \
      ->UseRealTime()                     \
      ->Unit(benchmark::kMillisecond)
HEEL_SCENE(home);
HEEL_SCENE(wardrobe);
HEEL_SCENE(corridor);
HEEL_SCENE(crowd);
BENCHMARK(BM_StepWithoutPictures)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Setup)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace heel

BENCHMARK_MAIN();
