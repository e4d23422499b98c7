// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_episode.hpp>
#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/random.hpp>
#include <heel/planning/global_planner.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kBodyRadius_m = 0.3;  // With a little room to walk.
constexpr double kWaitsEvery_m = 2.2;  // Of the person's way.
constexpr double kCell_m = 0.05;

OccupancyGrid rasterized(const Scene& scene) {
  const FloorBounds flat = floorBounds(scene);
  const Vector2d size = (flat.high - flat.low) / kCell_m;
  OccupancyGrid grid(flat.low, kCell_m, static_cast<int>(size.x()) + 1,
                     static_cast<int>(size.y()) + 1);
  const FloorPlan plan(scene);
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const GridCell cell{x, y};
      if (plan.clearance(grid.center(cell)) < kCell_m / 2.0) grid.at(cell) = Occupancy::kOccupied;
    }
  }
  return grid;
}

GlobalPlannerParams walking() {
  GlobalPlannerParams params;
  params.robot_radius_m = kBodyRadius_m;
  return params;
}

/// Writes people's ways through a home.
class Ways {
 public:
  Ways(const RandomHome& home, RandomStream& random)
      : home_(home),
        random_(random),
        plan_(home.scene),
        planner_(rasterized(home.scene), walking()) {}

  /// A free place of a room that can be reached from `from`; `from` itself if none was found.
  Vector2d placeIn(const Room& room, const Vector2d& from) {
    for (int attempt = 0; attempt < 50; ++attempt) {
      const Vector2d place(random_.uniform(room.low.x() + 0.6, room.high.x() - 0.6),
                           random_.uniform(room.low.y() + 0.6, room.high.y() - 0.6));
      if (plan_.clearance(place) < 0.55) continue;
      if (planner_.plan(from, place).status == PlanStatus::kFound) return place;
    }
    return from;
  }

  /// Walks there; if `waits`, stops every few metres until the robot has come near.
  void walk(ScenePerson& person, Vector2d& at, const Vector2d& to, double speed_mps, bool waits) {
    const GlobalPlan way = planner_.plan(at, to);
    if (!way.found()) return;
    double gone_m = 0.0;
    for (const Vector2d& corner : resample(way.path, 1.1)) {
      if (corner == way.path.front()) continue;
      gone_m += (corner - at).norm();
      at = corner;
      PathStep step;
      step.kind = PathStep::Kind::kWalk;
      step.to = corner;
      step.speed_mps = speed_mps;
      person.path.push_back(step);
      if (!waits || gone_m < kWaitsEvery_m) continue;
      gone_m = 0.0;
      waitForRobot(person, random_.uniform(1.6, 2.2), 25.0);
    }
  }

  void waitForRobot(ScenePerson& person, double within_m, double patience_s) const {
    PathStep step;
    step.kind = PathStep::Kind::kWaitForRobot;
    step.robot_within_m = within_m;
    step.patience_s = patience_s;
    step.comes_back = true;
    person.path.push_back(step);
  }

  void wait(ScenePerson& person, double wait_s) const {
    PathStep step;
    step.wait_s = wait_s;
    person.path.push_back(step);
  }

  const Room& randomRoom() {
    const auto rooms = static_cast<double>(home_.rooms.size());
    return home_.rooms[static_cast<std::size_t>(random_.uniform() * rooms)];
  }

 private:
  const RandomHome& home_;
  RandomStream& random_;
  FloorPlan plan_;
  GlobalPlanner planner_;
};

/// In from beside the robot, where it does not look; about before it, so that it sees all sides.
void showUp(ScenePerson& person, Vector2d& at, const RobotParams& robot, double empty_s, Ways& ways,
            RandomStream& random) {
  const Eigen::Rotation2Dd turn(robot.start_yaw_rad);
  const auto place = [&](double x, double y) -> Vector2d {
    return robot.start + turn * Vector2d(x, y);
  };
  const double side = random.uniform() < 0.5 ? 1.0 : -1.0;
  person.start = at = place(0.1, 0.95 * side);
  person.start_yaw_rad = robot.start_yaw_rad;
  ways.wait(person, empty_s);
  const double speed_mps = random.uniform(0.6, 0.9);
  for (const Vector2d& to : {place(2.0, 0.5 * side), place(2.6, -0.6), place(3.3, 0.5),
                             place(2.2, 0.3), place(2.8, -0.2)}) {
    PathStep step;
    step.kind = PathStep::Kind::kWalk;
    step.to = at = to;
    step.speed_mps = speed_mps;
    person.path.push_back(step);
    ways.wait(person, 0.4);
  }
  ways.waitForRobot(person, 1.7, 12.0);
}

/// The first is the one to follow: anybody, and whoever looks like them may be about.
std::vector<ScenePerson> inAnyOrder(std::vector<ScenePerson> people, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 33));
  for (std::size_t i = people.size(); i > 1; --i) {
    std::swap(people[i - 1],
              people[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  return people;
}

}  // namespace

Scene randomEpisode(std::uint64_t seed, const std::filesystem::path& scenes,
                    const RandomEpisodeParams& params) {
  RandomHome home = randomHome(seed, scenes / "models" / "furniture.yaml");
  RandomStream random(hashOf(seed, 31));
  Ways ways(home, random);

  const std::vector<ScenePerson> people = inAnyOrder(randomWardrobe(seed).people, seed);
  ScenePerson person = people.front();
  Vector2d at;
  showUp(person, at, home.scene.robot, params.empty_s, ways, random);
  const double speed_mps = random.uniform(0.4, 0.7);
  for (int visit = 0; visit < params.visits; ++visit) {
    ways.walk(person, at, ways.placeIn(ways.randomRoom(), at), speed_mps, true);
    ways.waitForRobot(person, 1.5, 40.0);
    ways.wait(person, random.uniform(0.5, 2.0));
  }
  home.scene.people.push_back(std::move(person));

  const int others = static_cast<int>(random.uniform() * (params.max_others + 1));
  for (int i = 0; i < others; ++i) {
    ScenePerson other = people[static_cast<std::size_t>(1 + i)];
    const std::size_t room = 1 + static_cast<std::size_t>(random.uniform() * 4.0);
    const Vector2d doorstep = home.rooms.back().low + Vector2d(1.0 + 3.0 * i, 0.7);
    Vector2d where = ways.placeIn(home.rooms[room], doorstep);
    other.start = where;
    ways.wait(other, 17.0);  // So that the first to enter is the one to follow.
    const Vector2d first = where;
    for (int walk = 0; walk < 4; ++walk) {
      ways.walk(other, where, ways.placeIn(ways.randomRoom(), where), random.uniform(0.5, 1.0),
                false);
      ways.wait(other, random.uniform(1.0, 5.0));
    }
    ways.walk(other, where, first, random.uniform(0.5, 1.0), false);
    other.repeat = true;
    home.scene.people.push_back(std::move(other));
  }

  CameraParams& camera = home.scene.robot.camera;
  camera.width = 320;
  camera.height = 240;
  camera.rate_hz = params.camera_rate_hz;
  camera.drawn_light = true;
  LaserParams& laser = home.scene.robot.laser;
  laser.view_rad = 2.0 * M_PI;  // People who pass by the robot stay in view of it.
  laser.beams = 361;
  home.scene.name = "episode " + std::to_string(seed);
  return std::move(home.scene);
}

}  // namespace heel
