// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/renderer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Whether two pixels show different surfaces, and light that a person could tell apart.
bool isEdge(int key, int other_key, const cv::Vec3f& light, const cv::Vec3f& other_light) {
  if (key == other_key) return false;
  float difference = 0.0F, sum = 0.0F;
  for (int i = 0; i < 3; ++i) {
    difference = std::max(difference, std::abs(light[i] - other_light[i]));
    sum = std::max(sum, light[i] + other_light[i]);
  }
  return difference > 0.12F * sum;
}

/// Marks the pixels of a row at which surfaces meet.
void findEdges(const RenderedView& view, int v, std::vector<int>& edges) {
  const int last_u = view.depth_m.cols - 1, last_v = view.depth_m.rows - 1;
  const int rows[3] = {std::max(v - 1, 0), v, std::min(v + 1, last_v)};
  const int* keys[3];
  const cv::Vec3f* light[3];
  for (int i = 0; i < 3; ++i) {
    keys[i] = view.surface.ptr<int>(rows[i]);
    light[i] = view.radiance.ptr<cv::Vec3f>(rows[i]);
  }
  edges.clear();
  for (int u = 0; u <= last_u; ++u) {
    const int before = std::max(u - 1, 0), after = std::min(u + 1, last_u);
    const int key = keys[1][u];
    const cv::Vec3f& here = light[1][u];
    if (isEdge(key, keys[1][before], here, light[1][before]) ||
        isEdge(key, keys[1][after], here, light[1][after]) ||
        isEdge(key, keys[0][u], here, light[0][u]) || isEdge(key, keys[2][u], here, light[2][u])) {
      edges.push_back(u);
    }
  }
}

/// Where surfaces meet, a pixel is the average of its centre and two more rays.
void smoothRow(const RayWorld& world, const Shader& shader, const Lens& lens, int v,
               const std::vector<int>& edges, RenderedView& view) {
  static constexpr float kOffsets[2][2] = {{-0.34F, -0.17F}, {0.34F, 0.17F}};
  constexpr std::size_t kPixels = RayWorld::kPacket / 2;
  auto* radiance = view.radiance.ptr<cv::Vec3f>(v);
  std::array<Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  NearbyShadow shadow;
  for (std::size_t first = 0; first < edges.size(); first += kPixels) {
    const std::size_t pixels = std::min(kPixels, edges.size() - first);
    for (std::size_t i = 0; i < 2 * pixels; ++i) {
      directions[i] = lens.direction(static_cast<float>(edges[first + i / 2]) + kOffsets[i % 2][0],
                                     static_cast<float>(v) + kOffsets[i % 2][1]);
    }
    world.trace(lens.origin, directions.data(), static_cast<int>(2 * pixels), hits);
    for (std::size_t i = 0; i < 2 * pixels; i += 2) {
      const Rgb sum = shader.radiance(lens.ray(directions[i]), hits[i], shadow, false) +
                      shader.radiance(lens.ray(directions[i + 1]), hits[i + 1], shadow, true);
      cv::Vec3f& pixel = radiance[edges[first + i / 2]];
      pixel = (pixel + toBgr(sum)) / 3.0F;
    }
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
  // First all edges, then their smoothing: rows must not see neighbours that are smoothed already.
  std::vector<std::vector<int>> edges(static_cast<std::size_t>(camera.height));
  tbb::parallel_for(0, camera.height,
                    [&](int v) { findEdges(view, v, edges[static_cast<std::size_t>(v)]); });
  tbb::parallel_for(0, camera.height, [&](int v) {
    smoothRow(world, shader, lens, v, edges[static_cast<std::size_t>(v)], view);
  });
}

}  // namespace heel
