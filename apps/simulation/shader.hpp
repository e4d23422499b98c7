// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The light that comes back along a ray: materials, clothes, shadows and highlights.
#pragma once

#include "apps/simulation/light_map.hpp"

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

/// People's shadows at the ray before, for a neighbour on the same face to share.
struct NearbyShadow {
  int face = -1;
  std::array<float, 64> seen;  ///< The share of each of the face's sources.
};

/// Colours hits. Reads the ray world's people of the moment; `const` members are thread-safe.
class Shader {
 public:
  /// All arguments must outlive this.
  Shader(const Scene& scene, const Geometry& geometry, const RayWorld& world,
         const LightMap& lights);

  /// To be called when the world's people have changed.
  void peopleHaveMoved();

  /// Radiance that comes back from `hit`; black where there is nothing.
  ///
  /// @param shadow  In and out. Where `share_shadow` is set and the face is the same as before,
  ///                people's shadows are those of the ray before.
  Rgb radiance(const ShadedRay& ray, const RayHit& hit, NearbyShadow& shadow,
               bool share_shadow) const;

 private:
  struct FaceFrame {
    Eigen::Vector3f per_u;  // Dot with (point - origin) gives [0, 1] along the edge.
    Eigen::Vector3f per_v;
    float length_u;
    float length_v;
  };

  Rgb faceRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p,
                   NearbyShadow& shadow, bool share_shadow) const;
  Rgb pillarRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p) const;
  Rgb bodyRadiance(const ShadedRay& ray, const RayHit& hit, const Eigen::Vector3f& p) const;
  Rgb bodyColor(const BodyPart& part, const Eigen::Vector3f& p, float footprint_m) const;
  Rgb clothColor(const Cloth& cloth, float u, float v, float footprint_m) const;
  /// Light from all sources and from the room, with every shadow, on something that moves.
  Rgb lightInRoom(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;
  /// How many of a source's points people do not hide from `p`.
  int countSeen(const Eigen::Vector3f& p, const Eigen::Vector3f* points, int count) const;
  /// The share of a source that people do not keep from `p`.
  float notShaded(std::size_t source, const Eigen::Vector3f& p) const;

  const Scene& scene_;
  const Geometry& geometry_;
  const RayWorld& world_;
  const LightMap& lights_;
  std::vector<FaceFrame> frames_;
  std::vector<std::uint64_t> lit_people_;  // For each source, whom its light reaches, one bit each.
  Texture weave_;
  Texture folds_;
};

}  // namespace heel
