// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/rough_world.hpp>
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

struct RoughSwitch {
  const char* name;
  bool RoughWorld::*flag;
};
constexpr std::array<RoughSwitch, 6> kRoughSwitches = {{{"people", &RoughWorld::people},
                                                        {"latency", &RoughWorld::latency},
                                                        {"map", &RoughWorld::map},
                                                        {"laser", &RoughWorld::laser},
                                                        {"light", &RoughWorld::light},
                                                        {"odometry", &RoughWorld::odometry}}};
constexpr double kLaserView_rad = 220.0 / 180.0 * M_PI;
constexpr double kMapOff_m = 0.1;
constexpr double kBias = 0.03;

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
  for (ScenePerson& person : scene.people) person.sees_robot = person.sees_robot && !rough.people;
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
