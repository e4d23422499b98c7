// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/laser.hpp>
#include <heel/apps/simulation/random.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr float kBehind_m = 1e-3F;  // A beam that goes on starts so far behind the surface.

LaserEcho materialOf(const RayHit& hit, const Geometry& geometry) {
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

// How far a ray goes that hits this first, in lengths of its direction; infinite without an echo.
double echoOf(RayHit hit, const RayWorld& world, const Geometry& geometry,
              const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  float passed = 0.0F;
  while (materialOf(hit, geometry) == LaserEcho::kPassed) {
    passed += hit.distance + kBehind_m;
    hit = world.trace(origin + passed * direction, direction);
  }
  return materialOf(hit, geometry) == LaserEcho::kReturned
             ? static_cast<double>(passed + hit.distance)
             : std::numeric_limits<double>::infinity();
}

/// Measures along rays from one point: tells how far the i-th goes, in lengths of its direction,
/// with noise; infinite without an echo.
template <typename DirectionOf, typename Take>
void measure(const RayWorld& world, const Geometry& geometry, const Eigen::Vector3f& origin,
             int rays, double noise_m, std::uint64_t noise, DirectionOf directionOf, Take take) {
  RandomStream random(noise);
  std::array<Eigen::Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  for (int first = 0; first < rays; first += RayWorld::kPacket) {
    const int count = std::min(RayWorld::kPacket, rays - first);
    for (int i = 0; i < count; ++i)
      directions[static_cast<std::size_t>(i)] = directionOf(first + i);
    world.trace(origin, directions.data(), count, hits);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      take(first + i,
           echoOf(hits[at], world, geometry, origin, directions[at]) + noise_m * random.gaussian());
    }
  }
}

}  // namespace

void measureLaser(const RayWorld& world, const Geometry& geometry, const LaserParams& params,
                  const FloorPose& robot, std::uint64_t noise, LaserScan& scan) {
  scan.first_rad = -params.view_rad / 2.0;
  scan.step_rad = params.view_rad / (params.beams - 1);
  scan.ranges_m.resize(static_cast<std::size_t>(params.beams));
  const auto directionOf = [&](int beam) -> Eigen::Vector3f {
    const double angle = robot.yaw_rad + scan.first_rad + beam * scan.step_rad;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F};
  };
  measure(world, geometry, (basePose(robot) * params.at).cast<float>(), params.beams,
          params.noise_m, noise, directionOf, [&](int beam, double range_m) {
            scan.ranges_m[static_cast<std::size_t>(beam)] =
                range_m <= params.max_range_m ? static_cast<float>(std::max(range_m, 0.0))
                                              : std::numeric_limits<float>::infinity();
          });
}

void measureFloor(const RayWorld& world, const Geometry& geometry, const FloorCameraParams& params,
                  const FloorPose& robot, std::uint64_t noise, cv::Mat& depth_m) {
  const PinholeCamera camera = pinholeOf(params);
  const Eigen::Isometry3f T_world_camera =
      (basePose(robot) * mountedCamera(params.at, params.pitch_rad)).cast<float>();
  depth_m.create(params.height, params.width, CV_32FC1);
  const auto directionOf = [&](int i) -> Eigen::Vector3f {
    return T_world_camera.linear() *
           rayOf(camera, i % params.width, i / params.width).cast<float>();
  };
  measure(world, geometry, T_world_camera.translation(), params.width * params.height,
          params.noise_m, noise, directionOf, [&](int i, double z_m) {
            depth_m.at<float>(i / params.width, i % params.width) =
                z_m <= params.max_range_m ? static_cast<float>(z_m)
                                          : std::numeric_limits<float>::quiet_NaN();
          });
}

}  // namespace heel
