// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The light on everything that never moves, worked out once: shadows of furniture, and light that
/// walls and floor throw on each other.
#pragma once

#include <heel/apps/simulation/face_grid.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/light_source.hpp>
#include <heel/apps/simulation/ray_world.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace heel {

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
  /// Which of `sourcesOn(face)` reach the neighbourhood of a place on it, one bit each; coarse.
  const FaceGrid<std::uint64_t>& sourcesNear(int face) const {
    return near_[static_cast<std::size_t>(face)];
  }
  /// All light on a face when nobody is about: from the sources, and from other surfaces.
  Rgb still(int face, float a, float b) const {
    return still_[static_cast<std::size_t>(face)].at(a, b).head<3>();
  }
  /// The light about a place in the room, for what moves through it.
  RoomLight inRoom(const Eigen::Vector3f& p) const;

  const std::vector<LightSource>& sources() const { return sources_; }

 private:
  struct Probe {
    bool valid = false;
    RoomLight light;
  };

  void bakeDirect(const Geometry& geometry, const RayWorld& world);
  void noteSources(const Geometry& geometry);
  void bakeBounce(const Geometry& geometry, const RayWorld& world);
  /// Adds up `still_` from the sources and what bounces.
  void sumUp(const Geometry& geometry, const std::vector<FaceGrid<Rgb>>& bounced);
  void bakeProbes(const Geometry& geometry, const RayWorld& world, const FloorPlan& plan,
                  const FloorBounds& flat);
  Rgb radianceFrom(const Geometry& geometry, const RayHit& hit, const Eigen::Vector3f& point) const;
  Rgb gather(const Geometry& geometry, const RayWorld& world, const Eigen::Vector3f& p,
             const Eigen::Vector3f& normal, int rays, std::uint64_t seed) const;

  std::vector<LightSource> sources_;
  std::vector<std::vector<SourceOnFace>> direct_;
  std::vector<FaceGrid<std::uint64_t>> near_;
  std::vector<FaceGrid<Eigen::Array4f>> still_;  // The fourth number makes them quicker to read.
  std::vector<Probe> probes_;
  Eigen::Vector2f probe_low_ = Eigen::Vector2f::Zero();
  int probe_columns_ = 0;
  int probe_rows_ = 0;
};

}  // namespace heel
