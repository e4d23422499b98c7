// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The light that comes back along a ray: materials, clothes, shadows and highlights.
#pragma once

#include <heel/apps/simulation/people_shadows.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace heel {

/// What one ray saw.
struct ShadedRay {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;  ///< Length such that distance 1 is optical depth 1 m.
  float pixel_rad = 0.0F;     ///< Angle of a pixel: how much of a surface it averages.
};

/// What rays that hit the same face, pillar or body part close to each other share.
struct NearbyLight {
  RayHit::Kind kind = RayHit::Kind::kNothing;
  int index = -1;
  std::uint64_t known = 0;     ///< The sources that people were looked for before, one bit each.
  std::array<float, 64> seen;  ///< The share of each of those that they leave.
  RoomLight room;              ///< About a pillar or a body.
};

/// Colours hits. Reads the ray world's people of the moment; `const` members are thread-safe.
class Shader {
 public:
  /// All arguments must outlive this.
  Shader(const Scene& scene, const Geometry& geometry, const RayWorld& world,
         const LightMap& lights);

  /// To be called when the world's people have changed.
  void peopleHaveMoved() { shadows_.update(); }

  /// Radiance that comes back from `hit`; black where there is nothing.
  ///
  /// @param nearby  In and out: where the same thing is hit as before, people's shadows are those
  /// of
  ///                the rays before.
  Rgb radiance(const ShadedRay& ray, const RayHit& hit, NearbyLight& nearby) const;

 private:
  struct FaceFrame {
    Eigen::Vector3f per_u;  // Dot with (point - origin) gives [0, 1] along the edge.
    Eigen::Vector3f per_v;
    float texture_u;  // Where the texture starts, in tiles.
    float tiles_u;    // How often it repeats along the edges.
    float tiles_v;
    float tile_m;
  };

  Rgb faceRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p,
                   NearbyLight& nearby) const;
  Rgb pillarRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p,
                     NearbyLight& nearby) const;
  Rgb bodyRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p,
                   NearbyLight& nearby) const;
  Rgb bodyColor(const BodyPart& part, const Eigen::Vector3f& p, float footprint_m) const;
  Rgb clothColor(const Cloth& cloth, float u, float v, float footprint_m) const;
  /// Light from all sources and from the room, with every shadow, on something that moves.
  Rgb lightInRoom(const Eigen::Vector3f& p, const Eigen::Vector3f& normal,
                  NearbyLight& nearby) const;

  const Scene& scene_;
  const Geometry& geometry_;
  const RayWorld& world_;
  const LightMap& lights_;
  std::vector<FaceFrame> frames_;
  PeopleShadows shadows_;
  Texture weave_;
  Texture folds_;
};

}  // namespace heel
