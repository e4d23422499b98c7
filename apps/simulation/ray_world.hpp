// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Everything that a ray can hit: the still geometry, and the people of this moment.
#pragma once

#include <heel/apps/simulation/body.hpp>
#include <heel/apps/simulation/geometry.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace heel {

/// What a ray hit first.
struct RayHit {
  enum class Kind { kNothing, kFace, kPillar, kBody };
  Kind kind = Kind::kNothing;
  int index = 0;                                     ///< Of the face, pillar or body part.
  float distance = 0.0F;                             ///< In lengths of the ray's direction.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< Unit length, towards the ray's start.
};

/// The part of the world that a question is about.
enum class RayTarget { kStill, kPeople, kAll };

/// An upright cylinder around one person.
struct PersonBounds {
  Eigen::Vector2f center = Eigen::Vector2f::Zero();
  float radius_m = 0.0F;
  float top_m = 0.0F;
};

/// Ray queries by Embree. `const` members can be called from several threads at a time.
class RayWorld {
 public:
  static constexpr int kPacket = 16;       ///< Rays that are traced at once.
  static constexpr int kShadowPacket = 8;  ///< Questions of blocked() at once.

  /// @param geometry  Must outlive this.
  explicit RayWorld(const Geometry& geometry);
  ~RayWorld();
  RayWorld(RayWorld&&) noexcept;
  RayWorld& operator=(RayWorld&&) noexcept;

  /// Replaces the people.
  void setPeople(std::vector<BodyPart> parts);
  const std::vector<BodyPart>& bodyParts() const;

  RayHit trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
               float max_distance = 1e9F, RayTarget target = RayTarget::kAll) const;

  /// Traces up to kPacket rays from one point; quickest where they are neighbours.
  void trace(const Eigen::Vector3f& origin, const Eigen::Vector3f* directions, int count,
             std::array<RayHit, kPacket>& hits) const;

  /// Whether anything is between two points. Give points a little off their surfaces.
  bool blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& to, RayTarget target) const;

  /// Up to kShadowPacket such questions at once: bit i of the answer tells whether `to[i]` is
  /// hidden.
  unsigned blocked(const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count,
                   RayTarget target) const;

  /// Whether a person may be within `margin_m` of the line between two points; quick, and never
  /// false where one is. Only the people in `who` count: bit i is the i-th of those in the world.
  bool peopleNear(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float margin_m,
                  std::uint64_t who = ~std::uint64_t{0}) const;

  /// Upright cylinders around the people, in the order of their first parts.
  const std::vector<PersonBounds>& people() const;

 private:
  struct Scenes;
  std::unique_ptr<Scenes> scenes_;
};

}  // namespace heel
