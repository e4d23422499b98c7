// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Light as it falls straight from lamps and windows.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// A lamp or a window as a source of light with a size.
class LightSource {
 public:
  explicit LightSource(const Light& light);

  /// Points spread over it, a little off whatever it is made of; the more, the softer its shadows.
  const std::vector<Eigen::Vector3f>& points() const { return points_; }
  /// How many of the points, from the first on, tell nearly as much as all.
  int firstPoints() const { return static_cast<int>(points_.size()) / 2; }
  /// How many will do where shapes are round and small: one of a lamp, two of a window.
  std::size_t pointsForBodies() const { return points_.size() / 3; }
  const Rgb& color() const { return color_; }
  const Eigen::Vector3f& center() const { return center_; }
  /// No point is further from the centre.
  float reach_m() const { return reach_m_; }

  /// What falls from `points()[i]` on a surface at `p`, were nothing in between: irradiance of
  /// white light, the share of all points.
  float irradiance(std::size_t i, const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

  /// What falls from all points, by those for bodies.
  float irradianceOnBody(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const;

 private:
  std::vector<Eigen::Vector3f> points_;
  Eigen::Vector3f center_;
  float reach_m_ = 0.0F;
  Eigen::Vector3f facing_ = Eigen::Vector3f::Zero();  // Zero: a lamp.
  float power_ = 0.0F;                                // Of one point.
  Rgb color_;
};

std::vector<LightSource> makeLightSources(const Scene& scene);

}  // namespace heel
