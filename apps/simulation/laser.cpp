// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/laser.hpp>
#include <heel/apps/simulation/random.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr float kBehind_m = 1e-3F;  // A beam that goes on starts so far behind the surface.

LaserEcho echoOf(const RayHit& hit, const Geometry& geometry) {
  const auto index = static_cast<std::size_t>(hit.index);
  switch (hit.kind) {
    case RayHit::Kind::kNothing:
      return LaserEcho::kSwallowed;
    case RayHit::Kind::kFace:
      return geometry.materials[geometry.faces[index].material].echo;
    case RayHit::Kind::kPillar:
      return geometry.materials[geometry.pillars[index].material].echo;
    case RayHit::Kind::kBody:
      break;
  }
  return LaserEcho::kReturned;
}

}  // namespace

void measureLaser(const RayWorld& world, const Geometry& geometry, const LaserParams& params,
                  const FloorPose& robot, std::uint64_t noise, LaserScan& scan) {
  const Eigen::Isometry3d T_world_base = basePose(robot);
  const Eigen::Vector3f origin = (T_world_base * params.at).cast<float>();
  scan.first_rad = -params.view_rad / 2.0;
  scan.step_rad = params.view_rad / (params.beams - 1);
  scan.ranges_m.resize(static_cast<std::size_t>(params.beams));
  RandomStream random(noise);
  std::array<Eigen::Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  for (int beam = 0; beam < params.beams; beam += RayWorld::kPacket) {
    const int count = std::min(RayWorld::kPacket, params.beams - beam);
    for (int i = 0; i < count; ++i) {
      const double angle = robot.yaw_rad + scan.first_rad + (beam + i) * scan.step_rad;
      directions[static_cast<std::size_t>(i)] = {static_cast<float>(std::cos(angle)),
                                                 static_cast<float>(std::sin(angle)), 0.0F};
    }
    world.trace(origin, directions.data(), count, hits);
    for (int i = 0; i < count; ++i) {
      RayHit hit = hits[static_cast<std::size_t>(i)];
      const Eigen::Vector3f& direction = directions[static_cast<std::size_t>(i)];
      float passed_m = 0.0F;
      while (echoOf(hit, geometry) == LaserEcho::kPassed) {
        passed_m += hit.distance + kBehind_m;
        hit = world.trace(origin + passed_m * direction, direction);
      }
      const double range = passed_m + hit.distance + params.noise_m * random.gaussian();
      const bool seen =
          echoOf(hit, geometry) == LaserEcho::kReturned && range <= params.max_range_m;
      scan.ranges_m[static_cast<std::size_t>(beam + i)] =
          seen ? static_cast<float>(std::max(range, 0.0)) : std::numeric_limits<float>::infinity();
    }
  }
}

}  // namespace heel
