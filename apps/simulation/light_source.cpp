// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/light_source.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector3f;

constexpr float kOffMaterial_m = 0.06F;

}  // namespace

LightSource::LightSource(const Light& light)
    : center_(light.at.cast<float>()), color_(light.color) {
  const Vector3f& at = center_;
  if (light.kind == Light::Kind::kLamp) {
    for (const double turn : {0.25, 1.25, 0.75, 1.75}) {
      const double angle = M_PI * turn, r = 0.7 * light.radius_m;
      points_.emplace_back(at + Vector3f(static_cast<float>(r * std::cos(angle)),
                                         static_cast<float>(r * std::sin(angle)), -kOffMaterial_m));
    }
  } else {
    facing_ = {static_cast<float>(std::cos(light.facing_rad)),
               static_cast<float>(std::sin(light.facing_rad)), 0.0F};
    const Vector3f along(-facing_.y(), facing_.x(), 0.0F);
    static constexpr float kSpread[6][2] = {{-0.33F, -0.25F}, {0.0F, 0.25F},  {0.33F, -0.25F},
                                            {-0.33F, 0.25F},  {0.0F, -0.25F}, {0.33F, 0.25F}};
    for (const auto& [x, z] : kSpread) {
      points_.emplace_back(at + facing_ * kOffMaterial_m +
                           along * x * static_cast<float>(light.width_m) +
                           Vector3f(0.0F, 0.0F, z * static_cast<float>(light.height_m)));
    }
  }
  for (const Vector3f& point : points_) reach_m_ = std::max(reach_m_, (point - at).norm());
  power_ = static_cast<float>(light.power / static_cast<double>(points_.size()));
}

float LightSource::irradiance(std::size_t i, const Vector3f& p, const Vector3f& normal) const {
  const Vector3f to = points_[i] - p;
  const float cosine = normal.dot(to);
  if (cosine <= 0.0F) return 0.0F;
  const float square = std::max(to.squaredNorm(), 0.01F);
  const float distance = std::sqrt(square);
  float share = 1.0F / (4.0F * static_cast<float>(M_PI));
  if (facing_.isZero()) {  // A lamp's shade keeps its light from the ceiling.
    share *= std::clamp(0.3F + 4.0F * to.z() / distance, 0.0F, 1.0F);
  } else {  // A window shines most straight into the room.
    share *= 4.0F * std::max(0.0F, -facing_.dot(to) / distance);
  }
  return power_ * share * cosine / (distance * square);
}

float LightSource::irradianceOnBody(const Vector3f& p, const Vector3f& normal) const {
  float sum = 0.0F;
  for (std::size_t i = 0; i < pointsForBodies(); ++i) sum += irradiance(i, p, normal);
  return sum * static_cast<float>(points_.size()) / static_cast<float>(pointsForBodies());
}

std::vector<LightSource> makeLightSources(const Scene& scene) {
  std::vector<LightSource> sources;
  for (const Light& light : scene.lights) {
    if (light.power > 0.0) sources.emplace_back(light);
  }
  return sources;
}

}  // namespace heel
