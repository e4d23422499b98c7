// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One decision of the local planner, in front of a doorway, with nobody and with three people,
/// on a grid of distances as a robot has it; and the search for a map's doorways.

#include "tests/support/drive_loop.hpp"
#include <heel/planning/doorways.hpp>
#include <heel/planning/local_planner.hpp>

#include <benchmark/benchmark.h>

namespace {

using Eigen::Vector2d;

/// Distances on 5 cm cells, the nearest cell's value.
class DistanceGrid {
 public:
  explicit DistanceGrid(const heel::test::DrawnFloor& floor) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        cells_.push_back(static_cast<float>(floor.clearance({0.05 * x + 0.025, 0.05 * y + 0.025})));
      }
    }
  }
  double operator()(const Vector2d& p) const {
    const int x = static_cast<int>(p.x() * 20.0), y = static_cast<int>(p.y() * 20.0);
    if (x < 0 || y < 0 || x >= kSide || y >= kSide) return 0.0;
    return cells_[static_cast<std::size_t>(y * kSide + x)];
  }

 private:
  static constexpr int kSide = 120;
  std::vector<float> cells_;
};

void decide(benchmark::State& state) {
  const auto floor = heel::test::roomWithDoorway(0.8);
  const DistanceGrid grid(floor);
  const auto path = heel::test::wayOn(floor, {1.5, 1.5}, {5.0, 2.5}, 0.26);
  std::vector<heel::MovingPerson> people = {{{4.0, 3.0}, {-0.5, 0.0}, 0.25},
                                            {{2.0, 3.2}, {0.0, -0.8}, 0.25},
                                            {{4.5, 1.0}, {0.3, 0.3}, 0.25}};
  people.resize(static_cast<std::size_t>(state.range(0)));
  heel::LocalPlanner planner;
  std::size_t futures = 0;
  for (auto _ : state) {
    auto plan = planner.step({{1.5, 1.5}, 0.2}, {0.25, 0.1}, path, grid, people);
    benchmark::DoNotOptimize(plan.command);
    futures = plan.options;
  }
  state.counters["futures"] = static_cast<double>(futures);
  state.counters["decisions/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(decide)->Arg(0)->Arg(3)->Unit(benchmark::kMicrosecond);

void doorways(benchmark::State& state) {
  const auto floor = heel::test::roomWithDoorway(0.8);
  heel::OccupancyGrid map({0.0, 0.0}, 0.05, 120, 80);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (floor.clearance(map.center({x, y})) <= 0.0) {
        map.at(heel::GridCell{x, y}) = heel::Occupancy::kOccupied;
      }
    }
  }
  for (auto _ : state) benchmark::DoNotOptimize(heel::findDoorways(map));
}
BENCHMARK(doorways)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
