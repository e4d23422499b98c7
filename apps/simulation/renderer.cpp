// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/renderer.hpp>

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

constexpr int kTile = 4;  // Pixels along an edge of what is traced at once.
static_assert(kTile * kTile == RayWorld::kPacket);

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

/// 0, or 1 + the number of the person that was hit.
std::uint8_t personNumber(const RayWorld& world, const RayHit& hit) {
  if (hit.kind != RayHit::Kind::kBody) return 0;
  return static_cast<std::uint8_t>(1 +
                                   world.bodyParts()[static_cast<std::size_t>(hit.index)].person);
}

cv::Vec3f toBgr(const Rgb& rgb) { return {rgb[2], rgb[1], rgb[0]}; }

/// Renders a square of 4 x 4 pixels: so many rays are traced at once. Each 2 x 2 of them share the
/// shadows of people.
void renderTile(const RayWorld& world, const Shader& shader, const Lens& lens, int left, int top,
                RenderedView& view) {
  std::array<cv::Point, RayWorld::kPacket> pixels;
  std::array<Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  std::size_t count = 0;
  for (int i = 0; i < RayWorld::kPacket; ++i) {  // 2 x 2 after 2 x 2.
    const cv::Point pixel(left + i / 4 % 2 * 2 + i % 2, top + i / 8 * 2 + i / 2 % 2);
    if (pixel.x >= view.depth_m.cols || pixel.y >= view.depth_m.rows) continue;
    pixels[count] = pixel;
    directions[count++] = lens.direction(static_cast<float>(pixel.x), static_cast<float>(pixel.y));
  }
  world.trace(lens.origin, directions.data(), static_cast<int>(count), hits);
  NearbyLight nearby;
  for (std::size_t i = 0; i < count; ++i) {
    const cv::Point& pixel = pixels[i];
    const RayHit& hit = hits[i];
    if (pixel.x % 2 == 0 && pixel.y % 2 == 0) nearby.kind = RayHit::Kind::kNothing;
    view.radiance.at<cv::Vec3f>(pixel) =
        toBgr(shader.radiance(lens.ray(directions[i]), hit, nearby));
    view.depth_m.at<float>(pixel) =
        hit.kind == RayHit::Kind::kNothing ? std::numeric_limits<float>::quiet_NaN() : hit.distance;
    view.people.at<std::uint8_t>(pixel) = personNumber(world, hit);
    view.surface.at<int>(pixel) = surfaceKey(world, hit);
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

/// Lists the pixels of four rows at which surfaces meet, column by column, so that those which
/// follow each other are near each other.
void findEdges(const RenderedView& view, int top, std::vector<cv::Point>& edges) {
  const int last_u = view.depth_m.cols - 1, last_v = view.depth_m.rows - 1;
  std::array<const int*, kTile + 2> keys;
  std::array<const cv::Vec3f*, kTile + 2> light;
  for (int i = 0; i < kTile + 2; ++i) {
    const int v = std::clamp(top + i - 1, 0, last_v);
    keys[static_cast<std::size_t>(i)] = view.surface.ptr<int>(v);
    light[static_cast<std::size_t>(i)] = view.radiance.ptr<cv::Vec3f>(v);
  }
  edges.clear();
  for (int u = 0; u <= last_u; ++u) {
    const int before = std::max(u - 1, 0), after = std::min(u + 1, last_u);
    for (int v = top; v < std::min(top + kTile, last_v + 1); ++v) {
      const auto row = static_cast<std::size_t>(v - top + 1);
      const auto differs = [&](int other_u, std::size_t other_row) {
        return isEdge(keys[row][u], keys[other_row][other_u], light[row][u],
                      light[other_row][other_u]);
      };
      if (differs(before, row) || differs(after, row) || differs(u, row - 1) ||
          differs(u, row + 1)) {
        edges.emplace_back(u, v);
      }
    }
  }
}

/// Where surfaces meet, a pixel is the average of its centre and two more rays.
void smooth(const RayWorld& world, const Shader& shader, const Lens& lens,
            const std::vector<cv::Point>& edges, RenderedView& view) {
  static constexpr float kOffsets[2][2] = {{-0.34F, -0.17F}, {0.34F, 0.17F}};
  constexpr std::size_t kPixels = RayWorld::kPacket / 2;
  std::array<Vector3f, RayWorld::kPacket> directions;
  std::array<RayHit, RayWorld::kPacket> hits;
  for (std::size_t first = 0; first < edges.size(); first += kPixels) {
    const std::size_t pixels = std::min(kPixels, edges.size() - first);
    for (std::size_t i = 0; i < 2 * pixels; ++i) {
      const cv::Point& pixel = edges[first + i / 2];
      directions[i] = lens.direction(static_cast<float>(pixel.x) + kOffsets[i % 2][0],
                                     static_cast<float>(pixel.y) + kOffsets[i % 2][1]);
    }
    world.trace(lens.origin, directions.data(), static_cast<int>(2 * pixels), hits);
    for (std::size_t i = 0; i < 2 * pixels; i += 2) {
      NearbyLight nearby;
      Rgb sum = shader.radiance(lens.ray(directions[i]), hits[i], nearby);
      sum += shader.radiance(lens.ray(directions[i + 1]), hits[i + 1], nearby);
      auto& pixel = view.radiance.at<cv::Vec3f>(edges[first + i / 2]);
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
  const int bands = (camera.height + kTile - 1) / kTile;
  tbb::parallel_for(0, bands, [&](int band) {
    for (int left = 0; left < camera.width; left += kTile) {
      renderTile(world, shader, lens, left, kTile * band, view);
    }
  });
  // First all edges, then their smoothing: what is looked at must not be smoothed already.
  std::vector<std::vector<cv::Point>> edges(static_cast<std::size_t>(bands));
  tbb::parallel_for(0, bands, [&](int band) {
    findEdges(view, kTile * band, edges[static_cast<std::size_t>(band)]);
  });
  tbb::parallel_for(0, bands, [&](int band) {
    smooth(world, shader, lens, edges[static_cast<std::size_t>(band)], view);
  });
}

}  // namespace heel
