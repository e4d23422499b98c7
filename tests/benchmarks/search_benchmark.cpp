// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How soon a search finds who walked off, in rough random homes: only the search is judged. The
/// robot knows where it is, drives by the map, and knows the person at once when they are in view.
/// It stands until they have been out of its view for two seconds, then it looks for them, for at
/// most 240 s. Prints a line a home, then a summary.
///   search_benchmark [FIRST_SEED [LAST_SEED]]

#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/experiment/rough_world.hpp>
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/person_search.hpp>
#include <heel/apps/simulation/path_driver.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/apps/simulation/simulator.hpp>
#include <heel/planning/global_planner.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

namespace {

using Eigen::Vector2d;
using heel::FloorPose;

constexpr double kStep_s = 0.1;
constexpr double kMost_s = 240.0;
constexpr double kLost_s = 2.0;
constexpr double kBody_m = 0.2;
constexpr double kEye_m = 1.2;

bool isInView(const heel::WorldTruth& truth, const heel::SearchMapParams& camera,
              const heel::WallMap& world) {
  const Vector2d& eye = truth.robot.position;
  const Vector2d& target = truth.people.front().position;
  const double away_m = (target - eye).norm();
  if (away_m < camera.min_range_m || away_m > camera.max_range_m) return false;
  const double bearing = std::abs(heel::bearingOf(truth.robot, target));
  if (bearing > 0.5 * camera.field_of_view_rad) return false;
  const Vector2d along = (target - eye) / away_m;
  const bool is_hidden =
      std::any_of(truth.people.begin() + 1, truth.people.end(), [&](const auto& other) {
        const Vector2d to = other.position - eye;
        const double ahead_m = to.dot(along);
        return ahead_m > 0.0 && ahead_m < away_m && (to - ahead_m * along).norm() < kBody_m;
      });
  return !is_hidden &&
         world.lineOfSight({eye.x(), eye.y(), kEye_m}, {target.x(), target.y(), kEye_m}, kBody_m);
}

/// Seconds until the person is found; nothing if they are not, or never were lost.
std::optional<double> searchedFor(std::uint64_t seed, bool& was_lost) {
  const heel::RoughWorld rough = heel::roughWorldOf("all");
  const heel::Scene scene = heel::roughened(heel::randomEpisode(seed, HEEL_SCENES), rough, seed);
  heel::Scene seen = scene;
  for (heel::Furniture& piece : seen.furniture) piece.in_map = true;
  const heel::WallMap solid = heel::wallMapOf(seen);
  const heel::WallMap walls = heel::wallMapOf(heel::asMapped(scene, rough, seed));

  heel::RobotDescription robot;
  robot.drive = scene.robot.drive;
  const heel::FollowerParams params = heel::fittedTo(robot, {});
  const heel::OccupancyGrid floor = walls.floorGrid({0.05, robot.height_m});
  heel::PersonSearch search(floor, walls.floorGrid({1.1, 1.4}), params.search);
  heel::GlobalPlanner planner(floor, params.paths);
  heel::GlobalPlan plan;

  heel::SimulatorOptions options;
  options.seed = seed;
  options.render = false;
  heel::Simulator world(scene, options);
  heel::MovingPerson last;
  double unseen_s = 0.0, searched_s = 0.0;
  bool is_there = false;
  was_lost = false;
  heel::VelocityCommand command;
  for (double s = 0.0; searched_s < kMost_s && s < 600.0; s += kStep_s) {
    const heel::Readings& now = world.step(kStep_s, command);
    command = {};
    const FloorPose& pose = now.truth.robot;
    if (s < 18.0) continue;  // They are learned.
    if (isInView(now.truth, params.search.map, solid)) {
      if (was_lost) return searched_s;
      last.position = now.truth.people.front().position;
      last.velocity = now.truth.people.front().velocity;
      unseen_s = 0.0;
      continue;
    }
    unseen_s += kStep_s;
    if (!was_lost) {
      if (unseen_s < kLost_s) continue;
      was_lost = true;
      search.lose(last, unseen_s, 1.0);
    }
    searched_s += kStep_s;
    search.wait(kStep_s, [](const Vector2d&) { return false; });
    search.look(pose, kStep_s,
                [](const Vector2d& place) -> std::optional<Vector2d> { return place; });
    if (now.laser != nullptr) {
      search.scan(*now.laser, pose * heel::FloorPose{scene.robot.laser.at.head<2>(), 0.0}, kStep_s);
    }
    const auto way_s = [&](const Vector2d& place) {
      planner.plan(pose.position, place, plan);
      return plan.found() ? plan.length_m / robot.drive.max_speed_mps
                          : std::numeric_limits<double>::infinity();
    };
    search.choose(kStep_s, pose, is_there, way_s);
    is_there = false;
    if (search.isOver()) return std::nullopt;
    const auto& view = search.view();
    if (!view) continue;
    if ((view->camera.position - pose.position).norm() < 0.15) {
      const Vector2d ahead = view->camera * Vector2d(2.0, 0.0);
      command.turn_radps =
          heel::turnToFace(robot.drive, {pose, now.truth.robot_speed}, ahead, params.drive.facing);
      is_there = command.turn_radps == 0.0;
      continue;
    }
    planner.plan(pose.position, view->camera.position, plan);
    if (!plan.found()) continue;
    const heel::FloorPath& path = plan.path;
    std::size_t next = 0;
    while (next + 1 < path.size() && (path[next] - pose.position).norm() < 0.15) ++next;
    command = heel::steerTo(pose, path[next]);
    if (heel::isSomebodyAhead(now.truth)) command.forward_mps = 0.0;
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const std::uint64_t last = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : first + 19;
  int lost = 0, found = 0;
  double total_s = 0.0;
  std::vector<double> times_s;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    bool was_lost = false;
    const std::optional<double> took_s = searchedFor(seed, was_lost);
    if (!was_lost) continue;
    ++lost;
    found += took_s ? 1 : 0;
    total_s += took_s.value_or(kMost_s);
    times_s.push_back(took_s.value_or(kMost_s));
    std::printf("home %lu: %s %.1f s\n", static_cast<unsigned long>(seed),
                took_s ? "found after" : "not found in", took_s.value_or(kMost_s));
    std::fflush(stdout);
  }
  std::sort(times_s.begin(), times_s.end());
  std::printf("%d lost, %d found, %.1f s in the mean, %.1f s in the middle\n", lost, found,
              total_s / std::max(lost, 1), times_s.empty() ? 0.0 : times_s[times_s.size() / 2]);
}
