// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/experiment/rough_world.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/material.hpp>
#include <heel/apps/simulation/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;

struct RoughSwitch {
  const char* name;
  bool RoughWorld::*flag;
};
constexpr std::array<RoughSwitch, 15> kRoughSwitches = {{{"people", &RoughWorld::people},
                                                         {"hurry", &RoughWorld::hurry},
                                                         {"company", &RoughWorld::company},
                                                         {"skirts", &RoughWorld::skirts},
                                                         {"drawers", &RoughWorld::drawers},
                                                         {"doors", &RoughWorld::doors},
                                                         {"steps", &RoughWorld::steps},
                                                         {"black", &RoughWorld::black},
                                                         {"glass", &RoughWorld::glass},
                                                         {"dropouts", &RoughWorld::dropouts},
                                                         {"latency", &RoughWorld::latency},
                                                         {"map", &RoughWorld::map},
                                                         {"laser", &RoughWorld::laser},
                                                         {"light", &RoughWorld::light},
                                                         {"odometry", &RoughWorld::odometry}}};
constexpr double kLaserView_rad = 220.0 / 180.0 * M_PI;
constexpr double kMapOff_m = 0.1;
constexpr double kBias = 0.03;
constexpr double kBesideOneAnother_m = 0.55;
constexpr double kRoomToWalk_m = 0.3;
constexpr double kDoorThickness_m = 0.04;
constexpr double kDropsOutEvery_s = 15.0;

void hurry(ScenePerson& person, double faster, RandomStream& random) {
  std::vector<PathStep> path;
  Vector2d at = person.start;
  for (PathStep step : person.path) {
    if (step.kind == PathStep::Kind::kWalk) {
      step.speed_mps *= faster;
      if (random.uniform() < 0.15) {  // of steps of up to 1.1 m
        PathStep half = step, stop;
        half.to = 0.5 * (at + step.to);
        stop.wait_s = random.uniform(0.5, 2.0);
        path.insert(path.end(), {half, stop});
      }
      at = step.to;
    }
    path.push_back(step);
  }
  person.path = std::move(path);
}

// Beside them where there is room, else in their steps.
ScenePerson besideThem(const ScenePerson& person, const FloorPlan& plan, ScenePerson other) {
  other.name = person.name + "'s company";
  other.path = person.path;
  other.repeat = person.repeat;
  const auto besideOf = [&plan](const Vector2d& place, const Vector2d& way) -> Vector2d {
    for (const double side_m : {kBesideOneAnother_m, -kBesideOneAnother_m}) {
      const Vector2d beside = place + side_m * Vector2d(-way.y(), way.x());
      if (plan.clearance(beside) > kRoomToWalk_m) return beside;
    }
    return place;
  };
  other.start = besideOf(person.start, Vector2d::UnitX());
  Vector2d at = person.start;
  for (PathStep& step : other.path) {
    if (step.kind != PathStep::Kind::kWalk) continue;
    const Vector2d to = step.to;
    step.to = besideOf(to, (to - at).normalized());
    at = to;
  }
  return other;
}

void addCompany(Scene& scene, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 75));
  const FloorPlan plan(scene);
  const Wardrobe wardrobe = randomWardrobe(hashOf(seed, 76));
  const std::size_t others = scene.people.size();
  for (std::size_t i = 1; i < others; ++i) {
    const bool is_alone = random.uniform() < 0.5, is_child = random.uniform() < 0.5;
    const double child_m = random.uniform(1.0, 1.3);
    if (is_alone) continue;
    ScenePerson other = wardrobe.people[i % wardrobe.people.size()];
    if (is_child) other.height_m = child_m;
    scene.people.push_back(besideThem(scene.people[i], plan, std::move(other)));
  }
}

// Whether somebody's way comes so near to a place.
bool isPassed(const Scene& scene, const Vector2d& place, double within_m) {
  return std::any_of(scene.people.begin(), scene.people.end(), [&](const ScenePerson& person) {
    Vector2d from = person.start;
    return std::any_of(person.path.begin(), person.path.end(), [&](const PathStep& step) {
      if (step.kind != PathStep::Kind::kWalk) return false;
      const FloorLine way{from, step.to};
      from = step.to;
      return (way.nearest(place) - place).norm() < within_m;
    });
  });
}

// In front of the piece, where nobody's way leads.
void openDrawers(Scene& scene, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 77));
  const FloorPlan plan(scene);
  const std::vector<Furniture> pieces = scene.furniture;
  for (const Furniture& piece : pieces) {
    const bool has_drawers = piece.name == "cupboard" || piece.name == "desk";
    const bool is_open = random.uniform() < 0.5;
    const double low_m = random.uniform(0.4, 0.75), out_m = random.uniform(0.25, 0.4);
    if (!has_drawers || !is_open) continue;
    const FurniturePart& body = piece.parts.front();
    const Eigen::Rotation2Dd turn(body.yaw_rad);
    FurniturePart drawer = body;
    drawer.size_m = {out_m, 0.45, 0.15};
    const Vector2d ahead = turn * Vector2d(0.5 * (body.size_m.x() + out_m), 0.0);
    drawer.base += Eigen::Vector3d(ahead.x(), ahead.y(), low_m - body.base.z());
    const Vector2d before = drawer.base.head<2>() + turn * Vector2d(0.5 * out_m + 0.5, 0.0);
    if (plan.clearance(before) < 0.4 || isPassed(scene, drawer.base.head<2>(), 0.9)) continue;
    scene.furniture.push_back({"open drawer", false, {drawer}});
  }
}

void hangDoors(Scene& scene, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 79));
  const FloorPlan plan(scene);
  for (const Wall& wall : scene.walls) {
    const Vector2d along = (wall.to - wall.from).normalized(), across(-along.y(), along.x());
    for (const Doorway& doorway : wall.doors) {
      const bool is_left = random.uniform() < 0.5, is_ahead = random.uniform() < 0.5;
      const bool is_hung = random.uniform() < 0.7;
      const double angle_rad = random.uniform(1.2, 2.2);  // from shut
      if (!is_hung) continue;
      const Vector2d middle = wall.from + along * doorway.at_m;
      const bool is_shut = !isPassed(scene, middle, 0.5 * doorway.width_m);
      const double side = is_left ? 1.0 : -1.0, face = is_ahead ? 1.0 : -1.0;
      const Vector2d hinge =
          middle + side * 0.5 * doorway.width_m * along +
          (is_shut ? 0.0 : 0.5 * (wall.thickness_m + kDoorThickness_m)) * face * across;
      const double open_rad = is_shut ? 0.0 : angle_rad;
      const Vector2d leaf = -side * std::cos(open_rad) * along + face * std::sin(open_rad) * across;
      FurniturePart door;
      const Vector2d at = hinge + 0.5 * doorway.width_m * leaf;
      door.base = {at.x(), at.y(), 0.01};
      door.size_m = {doorway.width_m, kDoorThickness_m, doorway.height_m - 0.02};
      door.yaw_rad = std::atan2(leaf.y(), leaf.x());
      door.surface = {"wood", usualColor("wood")};
      const auto is_free = [&](double share) {
        const Vector2d place = hinge + share * doorway.width_m * leaf;
        return plan.clearance(place) > 0.1 && !isPassed(scene, place, 0.35) &&
               (place - scene.robot.start).norm() > 1.0;
      };
      if (is_shut || (is_free(0.3) && is_free(0.5) && is_free(0.75) && is_free(1.0))) {
        scene.furniture.push_back({"door", false, {door}});
      }
    }
  }
}

void stepDown(Scene& scene, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 83));
  const FloorBounds flat = floorBounds(scene);
  for (int attempt = 0, steps = 0; attempt < 60 && steps < 3; ++attempt) {
    FloorArea area;
    for (int axis = 0; axis < 2; ++axis) {
      area.low[axis] = random.uniform(flat.low[axis], flat.high[axis]);
      area.high[axis] = area.low[axis] + random.uniform(0.6, 1.2);
    }
    area.depth_m = random.uniform(0.15, 0.5);
    area.surface = scene.floor;
    const Vector2d middle = 0.5 * (area.low + area.high);
    const double half_m = 0.5 * (area.high - area.low).norm();
    if (FloorPlan(scene).clearance(middle) < half_m || isPassed(scene, middle, half_m + 0.45) ||
        (scene.robot.start - middle).norm() < half_m + 2.5) {
      continue;
    }
    scene.floor_areas.push_back(area);
    ++steps;
  }
}

// A fifth of the pieces, by one draw for each.
void cover(Scene& scene, const char* material, bool only_mapped, std::uint64_t seed) {
  RandomStream random(seed);
  for (Furniture& piece : scene.furniture) {
    const bool is_covered = random.uniform() < 0.2;
    if (!is_covered || (only_mapped && !piece.in_map)) continue;
    for (FurniturePart& part : piece.parts) part.surface = {material, usualColor(material)};
  }
}

}  // namespace

const std::string& roughSwitches() {
  static const std::string kList = [] {
    std::string list;
    for (const RoughSwitch& s : kRoughSwitches)
      list += (list.empty() ? "" : ", ") + std::string(s.name);
    return list;
  }();
  return kList;
}

RoughWorld roughWorldOf(const std::string& list) {
  RoughWorld rough;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    bool is_known = false;
    for (const RoughSwitch& s : kRoughSwitches) {
      if (word != "all" && word != s.name) continue;
      rough.*s.flag = is_known = true;
    }
    if (!is_known) {
      throw std::invalid_argument("--rough: there is no switch '" + word + "'; there are " +
                                  roughSwitches() + ", and all");
    }
  }
  return rough;
}

Scene roughened(Scene scene, const RoughWorld& rough, std::uint64_t seed) {
  RandomStream random(hashOf(seed, 71));
  if (rough.hurry) {
    RandomStream paces(hashOf(seed, 74));
    for (ScenePerson& person : scene.people) {
      const bool is_other = &person != &scene.people.front();
      hurry(person, is_other ? paces.uniform(1.0, 1.6) : 1.0, paces);
    }
  }
  if (rough.company) addCompany(scene, seed);
  if (rough.drawers) openDrawers(scene, seed);
  if (rough.black) cover(scene, "velvet", false, hashOf(seed, 80));  // no door leaves
  if (rough.doors) hangDoors(scene, seed);
  if (rough.steps) stepDown(scene, seed);
  if (rough.glass) cover(scene, "frosted glass", true, hashOf(seed, 81));
  RandomStream skirts(hashOf(seed, 78));
  for (ScenePerson& person : scene.people) {
    person.sees_robot = person.sees_robot && !rough.people;
    if (rough.skirts) person.outfit.skirt = skirts.uniform() < 0.5;
  }
  LaserParams& laser = scene.robot.laser;
  if (rough.laser && laser.view_rad > kLaserView_rad) {
    laser.beams =
        1 + static_cast<int>(std::lround((laser.beams - 1) * kLaserView_rad / laser.view_rad));
    laser.view_rad = kLaserView_rad;
  }
  if (rough.light) scene.robot.camera.drawn_light = true;
  if (rough.odometry) {
    OdometryParams& odometry = scene.robot.odometry;
    odometry.distance_bias = random.uniform(-kBias, kBias);
    odometry.turn_bias = random.uniform(-kBias, kBias);
    odometry.drift_bias = random.uniform(-kBias, kBias);
  }
  return scene;
}

Scene asMapped(Scene scene, const RoughWorld& rough, std::uint64_t seed) {
  if (!rough.map) return scene;
  RandomStream random(hashOf(seed, 72));
  std::vector<Furniture*> mapped;
  for (Furniture& piece : scene.furniture) {
    if (!piece.in_map) continue;
    mapped.push_back(&piece);
    const double off_m = random.uniform(0.0, kMapOff_m), angle = random.uniform(-M_PI, M_PI);
    const Eigen::Vector3d off(off_m * std::cos(angle), off_m * std::sin(angle), 0.0);
    for (FurniturePart& part : piece.parts) part.base += off;
  }
  if (!mapped.empty()) {
    const double place = random.uniform() * static_cast<double>(mapped.size());
    mapped[static_cast<std::size_t>(place)]->in_map = false;
  }
  return scene;
}

std::vector<Fault> dropoutsOf(const RoughWorld& rough, double limit_s, std::uint64_t seed) {
  std::vector<Fault> faults;
  if (!rough.dropouts) return faults;
  for (const Fault::Kind kind : {Fault::Kind::kNoCamera, Fault::Kind::kNoLaser}) {
    RandomStream random(hashOf(seed, 82, static_cast<std::uint64_t>(kind)));
    for (double at_s = 0.0;;) {
      at_s += random.uniform(0.0, 2.0 * kDropsOutEvery_s);
      if (at_s > limit_s) break;
      faults.push_back({kind, at_s, at_s + random.uniform(0.2, 2.0)});
    }
  }
  return faults;
}

Latencies latenciesOf(const RoughWorld& rough, std::uint64_t seed) {
  if (!rough.latency) return {};
  RandomStream random(hashOf(seed, 73));
  Latencies latencies;
  latencies.camera_s = random.uniform(0.1, 0.25);
  latencies.laser_s = random.uniform(0.04, 0.1);
  latencies.wheels_s = random.uniform(0.04, 0.1);
  return latencies;
}

}  // namespace heel
