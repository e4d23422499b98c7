// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The light on everything that never moves, worked out once: shadows of furniture, and light that
/// walls and floor throw on each other.
#pragma once

#include "apps/simulation/floor_plan.hpp"
#include "apps/simulation/light_source.hpp"
#include "apps/simulation/ray_world.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace heel {

/// Values at the centres of a grid over a face, interpolated between them.
template <typename T>
struct FaceGrid {
  int columns = 0;
  int rows = 0;
  std::vector<T> values;

  /// `a`, `b` in [0, 1] along the face's edges.
  T at(float a, float b) const;
};

/// Light from one source on one face, with the shadows of all that stands still.
struct SourceOnFace {
  int source = 0;         ///< Index of the light source.
  FaceGrid<float> white;  ///< Irradiance, to be multiplied by the source's colour.
};

/// The light about one place.
struct RoomLight {
  std::array<Rgb, 6> bounced;    ///< Irradiance from +x, -x, +y, -y, +z, -z.
  std::array<float, 32> open{};  ///< How much of each source what stands still lets through.

  Rgb bouncedOn(const Eigen::Vector3f& normal) const;
};

/// Baked irradiance. Immutable once made.
class LightMap {
 public:
  LightMap(const Scene& scene, const Geometry& geometry, const RayWorld& world);

  /// The sources that reach a face.
  const std::vector<SourceOnFace>& sourcesOn(int face) const {
    return direct_[static_cast<std::size_t>(face)];
  }
  /// Which of `sourcesOn(face)` reach the neighbourhood of a place on it, one bit each.
  std::uint64_t sourcesAt(int face, float a, float b) const;
  /// Light that other surfaces throw on a face.
  Rgb bounced(int face, float a, float b) const {
    return bounced_[static_cast<std::size_t>(face)].at(a, b);
  }
  /// The light about a place in the room, for what moves through it.
  RoomLight inRoom(const Eigen::Vector3f& p) const;

  const std::vector<LightSource>& sources() const { return sources_; }

 private:
  struct Probe {
    bool valid = false;
    RoomLight light;
  };

  void noteSources(const Geometry& geometry);
  void bakeDirect(const Geometry& geometry, const RayWorld& world);
  void bakeBounce(const Geometry& geometry, const RayWorld& world);
  void bakeProbes(const Geometry& geometry, const RayWorld& world, const FloorPlan& plan,
                  const FloorBounds& flat);
  Rgb radianceFrom(const Geometry& geometry, const RayHit& hit, const Eigen::Vector3f& point) const;
  Rgb gather(const Geometry& geometry, const RayWorld& world, const Eigen::Vector3f& p,
             const Eigen::Vector3f& normal, int rays, std::uint64_t seed) const;

  std::vector<LightSource> sources_;
  std::vector<std::vector<SourceOnFace>> direct_;
  std::vector<FaceGrid<std::uint64_t>> near_;  // Coarse: bits of the sources that reach a square.
  std::vector<FaceGrid<Rgb>> bounced_;
  std::vector<Probe> probes_;
  Eigen::Vector2f probe_low_ = Eigen::Vector2f::Zero();
  int probe_columns_ = 0;
  int probe_rows_ = 0;
};

template <typename T>
T FaceGrid<T>::at(float a, float b) const {
  const float x = std::min(std::max(a * static_cast<float>(columns) - 0.5F, 0.0F),
                           static_cast<float>(columns - 1));
  const float y =
      std::min(std::max(b * static_cast<float>(rows) - 0.5F, 0.0F), static_cast<float>(rows - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, columns - 1), y1 = std::min(y0 + 1, rows - 1);
  const float wx = x - static_cast<float>(x0), wy = y - static_cast<float>(y0);
  const auto value = [this](int i, int j) -> const T& {
    return values[static_cast<std::size_t>(j * columns + i)];
  };
  const T upper = value(x0, y0) * (1.0F - wx) + value(x1, y0) * wx;
  const T lower = value(x0, y1) * (1.0F - wx) + value(x1, y1) * wx;
  return upper * (1.0F - wy) + lower * wy;
}

}  // namespace heel
