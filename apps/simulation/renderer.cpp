// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/renderer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace heel {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

/// The rays of a camera.
struct Lens {
  Vector3f origin;
  Matrix3f rotation;
  float fx, fy, cx, cy;

  Vector3f direction(float u, float v) const {
    return rotation * Vector3f((u - cx) / fx, (v - cy) / fy, 1.0F);
  }
  ShadedRay ray(const Vector3f& direction) const { return {origin, direction, 1.0F / fx}; }
};

/// A number for what must not be mixed within a pixel without care.
int surfaceKey(const RayWorld& world, const RayHit& hit) {
  int detail = hit.index;
  if (hit.kind == RayHit::Kind::kBody) {  // The capsules of one garment are one surface.
    const BodyPart& part = world.bodyParts()[static_cast<std::size_t>(hit.index)];
    detail = part.person * 8 + static_cast<int>(part.cover);
  }
  return (static_cast<int>(hit.kind) << 24) | detail;
}

cv::Vec3f toBgr(const Rgb& rgb) { return {rgb[2], rgb[1], rgb[0]}; }

/// @param shadows  One for each two columns; the second of two rows shares those of the first.
void renderRow(const RayWorld& world, const Shader& shader, const Lens& lens, int v,
               std::vector<NearbyShadow>& shadows, RenderedView& view) {
  auto* radiance = view.radiance.ptr<cv::Vec3f>(v);
  auto* depth = view.depth_m.ptr<float>(v);
  auto* people = view.people.ptr<std::uint8_t>(v);
  auto* surface = view.surface.ptr<int>(v);
  std::array<Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  for (int u = 0; u < view.depth_m.cols; u += RayWorld::kPacket) {
    const int count = std::min(RayWorld::kPacket, view.depth_m.cols - u);
    for (int i = 0; i < count; ++i) {
      directions[static_cast<std::size_t>(i)] =
          lens.direction(static_cast<float>(u + i), static_cast<float>(v));
    }
    world.trace(lens.origin, directions.data(), count, hits);
    for (int i = 0; i < count; ++i) {
      const RayHit& hit = hits[static_cast<std::size_t>(i)];
      NearbyShadow& shadow = shadows[static_cast<std::size_t>((u + i) / 2)];
      const bool share_shadow = v % 2 != 0 || i % 2 != 0;
      radiance[u + i] = toBgr(shader.radiance(lens.ray(directions[static_cast<std::size_t>(i)]),
                                              hit, shadow, share_shadow));
      depth[u + i] = hit.kind == RayHit::Kind::kNothing ? std::numeric_limits<float>::quiet_NaN()
                                                        : hit.distance;
      people[u + i] = hit.kind != RayHit::Kind::kBody
                          ? std::uint8_t{0}
                          : static_cast<std::uint8_t>(
                                1 + world.bodyParts()[static_cast<std::size_t>(hit.index)].person);
      surface[u + i] = surfaceKey(world, hit);
    }
  }
}

/// Where surfaces meet, a pixel is the average of its centre and two more rays.
void smoothRow(const RayWorld& world, const Shader& shader, const Lens& lens, int v,
               RenderedView& view) {
  static constexpr float kOffsets[2][2] = {{-0.34F, -0.17F}, {0.34F, 0.17F}};
  const int last_u = view.depth_m.cols - 1, last_v = view.depth_m.rows - 1;
  const auto* above = view.surface.ptr<int>(std::max(v - 1, 0));
  const auto* here = view.surface.ptr<int>(v);
  const auto* below = view.surface.ptr<int>(std::min(v + 1, last_v));
  auto* radiance = view.radiance.ptr<cv::Vec3f>(v);
  for (int u = 0; u <= last_u; ++u) {
    const int key = here[u];
    if (above[u] == key && below[u] == key && here[std::max(u - 1, 0)] == key &&
        here[std::min(u + 1, last_u)] == key) {
      continue;
    }
    Rgb sum = Rgb::Zero();
    NearbyShadow shadow;
    for (const auto& offset : kOffsets) {
      const Vector3f direction =
          lens.direction(static_cast<float>(u) + offset[0], static_cast<float>(v) + offset[1]);
      sum +=
          shader.radiance(lens.ray(direction), world.trace(lens.origin, direction), shadow, true);
    }
    radiance[u] = (radiance[u] + toBgr(sum)) / 3.0F;
  }
}

}  // namespace

void renderView(const RayWorld& world, const Shader& shader, const PinholeCamera& camera,
                const Eigen::Isometry3d& T_world_camera, RenderedView& view) {
  view.radiance.create(camera.height, camera.width, CV_32FC3);
  view.depth_m.create(camera.height, camera.width, CV_32FC1);
  view.people.create(camera.height, camera.width, CV_8UC1);
  view.surface.create(camera.height, camera.width, CV_32SC1);
  const Lens lens{T_world_camera.translation().cast<float>(),
                  T_world_camera.linear().cast<float>(),
                  static_cast<float>(camera.fx),
                  static_cast<float>(camera.fy),
                  static_cast<float>(camera.cx),
                  static_cast<float>(camera.cy)};
  tbb::parallel_for(0, (camera.height + 1) / 2, [&](int pair) {
    std::vector<NearbyShadow> shadows(static_cast<std::size_t>(camera.width + 1) / 2);
    for (int v = 2 * pair; v < std::min(2 * pair + 2, camera.height); ++v) {
      renderRow(world, shader, lens, v, shadows, view);
    }
  });
  tbb::parallel_for(0, camera.height, [&](int v) { smoothRow(world, shader, lens, v, view); });
}

}  // namespace heel
