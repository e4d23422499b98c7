// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/stereo_scene.hpp"

#include <opencv2/core.hpp>

#include <cmath>
#include <cstddef>

namespace heel::test {
namespace {

/// A value in [-1, 1] that depends on the lattice point and the seed alone.
double latticeValue(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t h = seed * 0x9E3779B97F4A7C15ULL +
                    static_cast<std::uint64_t>(x) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(y) * 0x94D049BB133111EBULL;
  h ^= h >> 31;
  h *= 0xD6E8FEB86659FD93ULL;
  h ^= h >> 32;
  return static_cast<double>(h & 0xFFFFFF) / static_cast<double>(0x7FFFFF) - 1.0;
}

/// Smooth noise with a grain of `grain` pixels.
double smoothNoise(double u, double v, double grain, std::uint64_t seed) {
  const double x = u / grain, y = v / grain;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double a = ease(x - x0), b = ease(y - y0);
  const auto i = static_cast<std::int64_t>(x0), j = static_cast<std::int64_t>(y0);
  const double top = (1 - a) * latticeValue(i, j, seed) + a * latticeValue(i + 1, j, seed);
  const double bottom =
      (1 - a) * latticeValue(i, j + 1, seed) + a * latticeValue(i + 1, j + 1, seed);
  return (1 - b) * top + b * bottom;
}

struct Hit {
  std::size_t surface = 0;
  double u = 0.0;  // in the left image
  double disparity = -1.0;
};

Hit nearest(const std::vector<Surface>& surfaces, double u, double v, bool from_right) {
  Hit hit;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& s = surfaces[i];
    // u_right = u - (disparity + slope_u u + slope_v v), solved for u.
    const double u_left = from_right ? (u + s.disparity + s.slope_v * v) / (1.0 - s.slope_u) : u;
    const double d = s.disparity + s.slope_u * u_left + s.slope_v * v;
    const bool covers = i == 0 || (u_left >= s.area.x && u_left < s.area.x + s.area.width &&
                                   v >= s.area.y && v < s.area.y + s.area.height);
    if (covers && d > hit.disparity) hit = {i, u_left, d};
  }
  return hit;
}

cv::Vec3b shade(const Surface& s, double u, double v, double noise, std::uint64_t seed) {
  const double texture =
      0.6 * smoothNoise(u, v, 3.0, seed) + 0.4 * smoothNoise(u, v, 11.0, seed + 1);
  cv::Vec3b bgr;
  for (int c = 0; c < 3; ++c) {
    bgr[c] = cv::saturate_cast<std::uint8_t>(s.colour_bgr[c] + s.contrast * texture + noise);
  }
  return bgr;
}

}  // namespace

StereoScene render(const std::vector<Surface>& surfaces, cv::Size size, double noise,
                   std::uint64_t seed) {
  StereoScene scene{cv::Mat(size, CV_8UC3), cv::Mat(size, CV_8UC3), cv::Mat1f(size),
                    cv::Mat1b(size), cv::Mat1b(size)};
  cv::RNG random(seed);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (const bool from_right : {false, true}) {
        const Hit hit = nearest(surfaces, x, y, from_right);
        const cv::Vec3b colour =
            shade(surfaces[hit.surface], hit.u, y, random.gaussian(noise), seed + 10 * hit.surface);
        if (from_right) {
          scene.right.at<cv::Vec3b>(y, x) = colour;
          continue;
        }
        scene.left.at<cv::Vec3b>(y, x) = colour;
        scene.disparity(y, x) = static_cast<float>(hit.disparity);
        scene.surface(y, x) = static_cast<std::uint8_t>(hit.surface);
        const double seen_at = x - hit.disparity;
        const Hit back = nearest(surfaces, seen_at, y, true);
        scene.seen_twice(y, x) = seen_at >= 0.0 && back.surface == hit.surface ? 255 : 0;
      }
    }
  }
  return scene;
}

std::vector<Surface> roomWithPerson() {
  return {
      {{0, 0, 640, 480}, 8.0, 0.002, 0.0, {150, 160, 165}, 40.0},     // back wall
      {{0, 260, 640, 220}, -26.0, 0.0, 0.13, {90, 110, 130}, 45.0},   // floor
      {{30, 90, 150, 250}, 17.0, 0.01, 0.0, {60, 90, 140}, 35.0},     // cupboard
      {{420, 300, 170, 110}, 24.0, 0.0, 0.05, {120, 120, 90}, 40.0},  // table
      {{300, 110, 44, 60}, 28.0, 0.0, 0.0, {130, 150, 190}, 35.0},    // head
      {{270, 165, 104, 130}, 28.5, 0.0, 0.0, {40, 40, 160}, 40.0},    // torso
      {{282, 290, 80, 140}, 28.0, 0.0, 0.0, {110, 60, 40}, 40.0},     // legs
  };
}

}  // namespace heel::test
