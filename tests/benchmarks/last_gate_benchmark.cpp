// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The last gate's promise in ten million drawn situations, or as many as are asked for: ends with
/// 1 if it was broken. Then the time of one velocity before a wall. After SECONDS no more is drawn.
///   last_gate_benchmark [SITUATIONS [SECONDS [SEED]]]

#include "tests/support/gate_trial.hpp"
#include <heel/planning/last_gate.hpp>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

/// Microseconds of a scan and a velocity, 360 beams on a wall that the robot drives up to.
double microseconds() {
  heel::LastGateParams params;
  params.wheels_latency_s = 0.05;
  heel::LastGate gate(params);
  heel::LaserScan scan;
  scan.step_rad = 6.283185307 / 360.0;
  for (int i = 0; i < 360; ++i) {
    const double cosine = std::cos(scan.angle(static_cast<std::size_t>(i)));
    scan.ranges_m.push_back(static_cast<float>(0.45 / std::fmax(cosine, 0.1)));
  }
  constexpr int kCalls = 20'000;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kCalls; ++i) {
    gate.addScan(scan, {}, 0.1 * i);
    gate.pass({0.3, 0.2}, {{}, {0.3, 0.2}}, 0.0, 0.1 * i);
  }
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  return took.count() / kCalls;
}

}  // namespace

int main(int argc, char** argv) {
  const long wanted = argc > 1 ? std::atol(argv[1]) : 10'000'000;
  const std::chrono::duration<double> most(argc > 2 ? std::atof(argv[2]) : 1e6);
  const auto start = std::chrono::steady_clock::now();
  long situations = 0, held_back = 0, broken = 0;
  double deepest_m = 0.0, way_m = 0.0;
  for (std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
       situations < wanted && std::chrono::steady_clock::now() - start < most; ++seed) {
    const heel::test::GateTrial trial = heel::test::runGateTrial(seed);
    situations += trial.situations;
    held_back += trial.held_back;
    way_m += trial.way_m;
    deepest_m = std::fmax(deepest_m, trial.deepest_m);
    if (trial.deepest_m < heel::test::kGateTouches_m && !trial.adds_speed) continue;
    ++broken;
    std::printf("broken with seed %lu: %.4f m deep%s\n", static_cast<unsigned long>(seed),
                trial.deepest_m, trial.adds_speed ? ", and adds speed" : "");
  }
  std::printf("%ld situations, %ld not let through as asked, %.0f m driven\n", situations,
              held_back, way_m);
  std::printf("%ld trials broke the promise; deepest %.5f m\n", broken, deepest_m);
  std::printf("a scan and a velocity take %.1f us\n", microseconds());
  return broken == 0 ? 0 : 1;
}
