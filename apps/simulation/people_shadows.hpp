// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Shadows that people throw on faces.
#pragma once

#include <heel/apps/simulation/light_map.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace heel {

/// Tells which light of the baked map people take away. `const` members are thread-safe.
class PeopleShadows {
 public:
  /// All arguments must outlive this.
  PeopleShadows(const Geometry& geometry, const RayWorld& world, const LightMap& lights);

  /// To be called when the world's people have moved.
  void update();

  /// Which of `sourcesOn(face)` people may keep from the neighbourhood of a place on it, one bit
  /// each. Quick: most of what a camera sees is in no one's shadow.
  std::uint64_t possible(int face, float a, float b) const {
    return possible_[static_cast<std::size_t>(face)].nearest(a, b);
  }

  /// The share of a source that people do not keep from `p`.
  float seen(std::size_t source, const Eigen::Vector3f& p) const;

  /// The same for several sources at once and with fewer of their points, which is enough for the
  /// rounded shapes of bodies.
  /// @param sources  One bit each.
  /// @param shares   Out: set for those sources.
  void lookFromBody(const Eigen::Vector3f& p, std::uint64_t sources,
                    std::array<float, 64>& shares) const;

 private:
  void noteWhoIsLit();
  /// How many of a source's points people do not hide from `p`.
  int countSeen(const Eigen::Vector3f& p, const Eigen::Vector3f* points, int count) const;

  const Geometry& geometry_;
  const RayWorld& world_;
  const LightMap& lights_;
  std::vector<std::uint64_t> lit_people_;  // For each source, whom its light reaches, one bit each.
  std::vector<FaceGrid<std::uint64_t>> possible_;
};

}  // namespace heel
