// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Localization against MRPT's particle filter: the same map, scans, odometry, 2000 particles and
/// 180 beams, a likelihood field of the same deviation, systematic resampling below half of the
/// effective size, one thread, and an estimate with covariance after every scan.

#include "tests/mapping/drawn_rooms.hpp"
#include <heel/mapping/localization.hpp>

#include <benchmark/benchmark.h>
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <vector>

namespace {

using heel::FloorPose;

constexpr std::size_t kParticles = 2000;
constexpr int kBeams = 180;
constexpr double kHit_m = 0.1;

/// A circle in a room of 8 m x 6 m.
struct Drive {
  heel::OccupancyGrid room = heel::test::oddRoom();
  FloorPose start{{4.0, 1.5}, 0.0};
  FloorPose step = heel::alongArc({}, 0.08, 0.1);
  std::vector<FloorPose> truth;
  std::vector<heel::LaserScan> scans;

  Drive() {
    FloorPose pose = start;
    for (int i = 0; i < 63; ++i) {
      pose = pose * step;
      truth.push_back(pose);
      scans.push_back(heel::test::scanOf(room, pose, kBeams));
    }
  }
};

const Drive& drive() {
  static const Drive result;
  return result;
}

void heelLocalization(benchmark::State& state) {
  heel::LocalizationParams params;
  params.min_particles = params.max_particles = kParticles;
  params.scan.beams = kBeams;
  params.field.hit_m = kHit_m;
  heel::Localization localization(drive().room, {}, params);
  localization.startAt(drive().start, 0.2, 0.1);
  std::size_t i = 0;
  double error_m = 0.0;
  for (auto _ : state) {
    const std::size_t at = i++ % drive().scans.size();
    if (at == 0) {
      state.PauseTiming();
      localization.startAt(drive().start, 0.2, 0.1);
      state.ResumeTiming();
    }
    localization.predict(drive().step);
    localization.update(drive().scans[at]);
    benchmark::DoNotOptimize(&localization.estimate());
    error_m += (localization.estimate().pose.position - drive().truth[at].position).norm();
  }
  state.counters["particles"] = static_cast<double>(localization.particles().size());
  state.counters["mean_error_m"] = error_m / static_cast<double>(i);
}
BENCHMARK(heelLocalization)->Unit(benchmark::kMicrosecond);

void mrptLocalization(benchmark::State& state) {
  const heel::OccupancyGrid& room = drive().room;
  const Eigen::Vector2d low = room.origin_m();
  auto map = mrpt::maps::COccupancyGridMap2D::Create();
  map->setSize(static_cast<float>(low.x()), static_cast<float>(low.x() + room.width() * 0.05),
               static_cast<float>(low.y()), static_cast<float>(low.y() + room.height() * 0.05),
               0.05F);
  for (heel::GridCell c; c.y < room.height(); ++c.y) {
    for (c.x = 0; c.x < room.width(); ++c.x) {
      map->setCell(c.x, c.y, room.at(c) == heel::Occupancy::kFree ? 1.0F : 0.0F);
    }
  }
  auto& likelihood = map->likelihoodOptions;
  likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  likelihood.LF_decimation = 1;
  likelihood.LF_stdHit = static_cast<float>(kHit_m);
  likelihood.LF_zHit = 0.7F;
  likelihood.LF_zRandom = 0.3F;
  likelihood.enableLikelihoodCache = true;

  // All data in MRPT's own types, made before the clock runs.
  std::vector<mrpt::obs::CSensoryFrame> frames;
  for (const heel::LaserScan& scan : drive().scans) {
    auto observation = mrpt::obs::CObservation2DRangeScan::Create();
    observation->aperture = static_cast<float>(heel::test::kPi);
    observation->rightToLeft = true;
    observation->maxRange = 20.0F;
    observation->resizeScan(scan.ranges_m.size());
    for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
      observation->setScanRange(b, scan.ranges_m[b]);
      observation->setScanRangeValidity(b, std::isfinite(scan.ranges_m[b]));
    }
    frames.emplace_back().insert(observation);
  }
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions motion;
  motion.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  movement.computeFromOdometry(
      {drive().step.position.x(), drive().step.position.y(), drive().step.yaw_rad}, motion);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);

  mrpt::random::getRandomGenerator().randomize(1);
  mrpt::slam::CMonteCarloLocalization2D pdf(kParticles);
  pdf.options.metricMap = map;
  mrpt::bayes::CParticleFilter filter;
  filter.m_options.adaptiveSampleSize = false;
  filter.m_options.sampleSize = kParticles;
  filter.m_options.BETA = 0.5;
  filter.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  filter.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  filter.m_options.powFactor = 0.15;
  const auto restart = [&] {
    pdf.resetUniform(drive().start.position.x() - 0.35, drive().start.position.x() + 0.35,
                     drive().start.position.y() - 0.35, drive().start.position.y() + 0.35, -0.17,
                     0.17, kParticles);
  };
  std::size_t i = 0;
  double error_m = 0.0;
  for (auto _ : state) {
    const std::size_t at = i++ % frames.size();
    if (at == 0) {
      state.PauseTiming();
      restart();
      state.ResumeTiming();
    }
    filter.executeOn(pdf, &actions, &frames[at]);
    const auto [covariance, mean] = pdf.getCovarianceAndMean();
    benchmark::DoNotOptimize(&covariance);
    error_m += (Eigen::Vector2d(mean.x(), mean.y()) - drive().truth[at].position).norm();
  }
  state.counters["particles"] = static_cast<double>(pdf.size());
  state.counters["mean_error_m"] = error_m / static_cast<double>(i);
}
BENCHMARK(mrptLocalization)->Unit(benchmark::kMicrosecond);

/// As the follower runs it: few particles, 60 beams.
void heelLocalizationWithDefaults(benchmark::State& state) {
  heel::Localization localization(drive().room);
  localization.startAt(drive().start, 0.2, 0.1);
  std::size_t i = 0;
  for (auto _ : state) {
    localization.predict(drive().step);
    localization.update(drive().scans[i++ % drive().scans.size()]);
    benchmark::DoNotOptimize(&localization.estimate());
  }
  state.counters["particles"] = static_cast<double>(localization.particles().size());
}
BENCHMARK(heelLocalizationWithDefaults)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
