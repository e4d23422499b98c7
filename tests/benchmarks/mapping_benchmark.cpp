// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One frame of the obstacle layer, its parts against OpenCV, and body checks against a walk over
/// all obstacles in closed form.

#include "tests/mapping/drawn_bodies.hpp"
#include <heel/mapping/body_check.hpp>
#include <heel/mapping/obstacle_layer.hpp>

#include <benchmark/benchmark.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <random>

namespace {

constexpr double kPi = 3.141592653589793;

heel::LaserScan scanOf(int beams) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> range(1.0F, 6.0F);
  heel::LaserScan scan;
  scan.first_rad = -kPi / 2.0;
  scan.step_rad = kPi / (beams - 1);
  for (int i = 0; i < beams; ++i) scan.ranges_m.push_back(range(random));
  return scan;
}

std::vector<Eigen::Vector3f> pointsOf(int count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> ahead(0.5F, 4.0F), aside(-1.5F, 1.5F), up(0.1F, 1.2F);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.emplace_back(ahead(random), aside(random), up(random));
  return points;
}

// A robot that drives on; arguments: beams, points.
void layerFrame(benchmark::State& state) {
  const auto scan = scanOf(static_cast<int>(state.range(0)));
  const auto points = pointsOf(static_cast<int>(state.range(1)));
  heel::ObstacleLayer layer;
  double time_s = 0.0;
  for (auto _ : state) {
    time_s += 1.0 / 30.0;
    layer.begin(time_s, {{0.3 * time_s, 0.1 * time_s}, 0.2 * time_s});
    layer.addScan(scan, {{0.12, 0.0}, 0.0});
    layer.addPoints(points);
    layer.finish();
  }
  state.counters["obstacles"] = static_cast<double>(layer.obstacles().size());
}
BENCHMARK(layerFrame)
    ->Args({181, 0})
    ->Args({181, 3000})
    ->Args({181, 30000})
    ->Args({720, 30000})
    ->Unit(benchmark::kMicrosecond);

std::vector<std::uint8_t> sparseCells() {
  std::mt19937 random(3);
  std::bernoulli_distribution wall(0.03);
  std::vector<std::uint8_t> cells(160 * 160);
  for (auto& cell : cells) cell = wall(random) ? 1 : 0;
  return cells;
}

void distanceTransform(benchmark::State& state) {
  const auto cells = sparseCells();
  heel::DistanceTransform transform;
  std::vector<float> out;
  for (auto _ : state) transform.compute(cells, 160, 160, 0.05, out);
}
BENCHMARK(distanceTransform)->Unit(benchmark::kMicrosecond);

void distanceTransformOpenCv(benchmark::State& state) {
  auto cells = sparseCells();
  for (auto& cell : cells) cell = cell == 0 ? 1 : 0;
  const cv::Mat free(160, 160, CV_8UC1, cells.data());
  cv::Mat out;
  for (auto _ : state) cv::distanceTransform(free, out, cv::DIST_L2, cv::DIST_MASK_PRECISE);
}
BENCHMARK(distanceTransformOpenCv)->Unit(benchmark::kMicrosecond);

std::vector<heel::FloorPose> posesOf(int count) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-2.7, 2.7);
  std::vector<heel::FloorPose> poses;
  for (int i = 0; i < count; ++i) poses.push_back({{place(random), place(random)}, place(random)});
  return poses;
}

heel::RobotBody bodyOf(bool box) {
  heel::RobotBody body;
  if (box) body.footprint = heel::BoxFootprint{0.5, 0.4, 0.0};
  return body;
}

// Argument of these four: whether the body is a box.
template <typename Ask>
void forEachPose(benchmark::State& state, Ask ask) {
  const auto poses = posesOf(256);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(poses[i++ % poses.size()]));
}

void wallCollision(benchmark::State& state) {
  const heel::BodyCheck check(bodyOf(state.range(0) != 0), heel::test::drawRoom(1, 0.05));
  forEachPose(state, [&](const heel::FloorPose& pose) { return check.collides(pose); });
}
void wallClearance(benchmark::State& state) {
  const heel::BodyCheck check(bodyOf(state.range(0) != 0), heel::test::drawRoom(1, 0.05));
  forEachPose(state, [&](const heel::FloorPose& pose) { return check.clearance(pose); });
}
void wallClearanceUpTo20cm(benchmark::State& state) {
  const heel::BodyCheck check(bodyOf(state.range(0) != 0), heel::test::drawRoom(1, 0.05));
  forEachPose(state, [&](const heel::FloorPose& pose) { return check.clearance(pose, 0.2); });
}
void wallBruteForce(benchmark::State& state) {
  const auto body = bodyOf(state.range(0) != 0);
  const auto boxes = heel::test::occupiedBoxes(heel::test::drawRoom(1, 0.05));
  forEachPose(state, [&](const heel::FloorPose& pose) {
    return heel::test::drawnClearance(body, pose, boxes);
  });
}
BENCHMARK(wallCollision)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(wallClearance)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(wallClearanceUpTo20cm)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(wallBruteForce)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

heel::ObstacleLayer fullLayer() {
  heel::ObstacleLayer layer;
  layer.begin(0.0, {});
  layer.addScan(scanOf(720), {});
  layer.addPoints(pointsOf(3000));
  layer.finish();
  return layer;
}

void layerCollision(benchmark::State& state) {
  const heel::BodyCheck check(bodyOf(state.range(0) != 0), octomap::OcTree(0.1));
  const auto layer = fullLayer();
  forEachPose(state, [&](const heel::FloorPose& pose) { return check.collides(pose, layer); });
}
void layerBruteForce(benchmark::State& state) {
  const auto body = bodyOf(state.range(0) != 0);
  std::vector<heel::test::DrawnBox> boxes;
  const auto layer = fullLayer();
  for (const auto& p : layer.obstacles()) {
    boxes.push_back({{p.x() - 0.025, p.y() - 0.025, 0.0}, {p.x() + 0.025, p.y() + 0.025, 1.1}});
  }
  forEachPose(state, [&](const heel::FloorPose& pose) {
    return heel::test::drawnClearance(body, pose, boxes);
  });
}
BENCHMARK(layerCollision)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(layerBruteForce)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
