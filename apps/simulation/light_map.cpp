// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/light_map.hpp"

#include "apps/simulation/random.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kPi = 3.14159265F;
constexpr float kDirectCell_m = 0.08F;  // Sharp enough for the shadow of a table's leg.
constexpr float kBounceCell_m = 0.3F;
constexpr float kNearCell_m = 1.0F;
constexpr float kProbeStep_m = 0.5F;
constexpr float kProbeHeight_m = 1.1F;
constexpr float kOffSurface_m = 0.002F;
constexpr float kNegligible = 2e-3F;

int cells(float length_m, float cell_m) {
  return std::clamp(static_cast<int>(std::ceil(length_m / cell_m)), 1, 400);
}

template <typename T>
FaceGrid<T> gridOver(const Face& face, float cell_m, const T& value) {
  FaceGrid<T> grid;
  grid.columns = cells(face.edge_u.norm(), cell_m);
  grid.rows = cells(face.edge_v.norm(), cell_m);
  grid.values.assign(static_cast<std::size_t>(grid.columns * grid.rows), value);
  return grid;
}

/// Calls `visit(point, value)` with the middle of each cell, a little off the face.
template <typename T, typename Visit>
void forEachCell(const Face& face, FaceGrid<T>& grid, const Visit& visit) {
  auto value = grid.values.begin();
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      const float a = (static_cast<float>(i) + 0.5F) / static_cast<float>(grid.columns);
      const float b = (static_cast<float>(j) + 0.5F) / static_cast<float>(grid.rows);
      visit(Vector3f(face.origin + a * face.edge_u + b * face.edge_v + kOffSurface_m * face.normal),
            *value++);
    }
  }
}

/// The i-th of n directions around `normal`, spread with the cosine's density.
Vector3f cosineDirection(const Vector3f& normal, int i, int n, float turn) {
  const float z2 = (static_cast<float>(i) + 0.5F) / static_cast<float>(n);
  const float angle = 2.3999632F * static_cast<float>(i) + turn;
  const float r = std::sqrt(1.0F - z2);
  const Vector3f helper = std::abs(normal.x()) > 0.7F ? Vector3f::UnitY() : Vector3f::UnitX();
  const Vector3f x = normal.cross(helper).normalized();
  const Vector3f y = normal.cross(x);
  return r * std::cos(angle) * x + r * std::sin(angle) * y + std::sqrt(z2) * normal;
}

}  // namespace

LightMap::LightMap(const Scene& scene, const Geometry& geometry, const RayWorld& world)
    : sources_(makeLightSources(scene)), direct_(geometry.faces.size()) {
  for (const Face& face : geometry.faces) {
    bounced_.push_back(gridOver<Rgb>(face, kBounceCell_m, Rgb::Zero()));
  }
  bakeDirect(geometry, world);
  noteSources(geometry);
  bakeBounce(geometry, world);
  bakeBounce(geometry, world);
  bakeProbes(geometry, world, FloorPlan(scene), floorBounds(scene));
}

void LightMap::bakeDirect(const Geometry& geometry, const RayWorld& world) {
  tbb::parallel_for(std::size_t{0}, geometry.faces.size(), [&](std::size_t f) {
    const Face& face = geometry.faces[f];
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const LightSource& source = sources_[s];
      SourceOnFace light{static_cast<int>(s), gridOver(face, kDirectCell_m, 0.0F)};
      float greatest = 0.0F;
      forEachCell(face, light.white, [&](const Vector3f& p, float& value) {
        for (std::size_t k = 0; k < source.points().size(); ++k) {
          const float falls = source.irradiance(k, p, face.normal);
          if (falls * static_cast<float>(source.points().size()) < kNegligible) continue;
          if (!world.blocked(p, source.points()[k], RayTarget::kStill)) value += falls;
        }
        greatest = std::max(greatest, value);
      });
      if (greatest > kNegligible && direct_[f].size() < 64) direct_[f].push_back(std::move(light));
    }
  });
}

void LightMap::noteSources(const Geometry& geometry) {
  for (std::size_t f = 0; f < geometry.faces.size(); ++f) {
    near_.push_back(gridOver(geometry.faces[f], kNearCell_m, std::uint64_t{0}));
    FaceGrid<std::uint64_t>& near = near_.back();
    for (std::size_t place = 0; place < direct_[f].size(); ++place) {
      const FaceGrid<float>& white = direct_[f][place].white;
      for (int j = 0; j < white.rows; ++j) {
        for (int i = 0; i < white.columns; ++i) {
          if (white.values[static_cast<std::size_t>(j * white.columns + i)] < kNegligible) continue;
          // Cells beside this one are lit too, where values are interpolated.
          for (int side = 0; side < 9; ++side) {
            const int x = std::clamp(i + side % 3 - 1, 0, white.columns - 1);
            const int y = std::clamp(j + side / 3 - 1, 0, white.rows - 1);
            const int column = x * near.columns / white.columns, row = y * near.rows / white.rows;
            near.values[static_cast<std::size_t>(row * near.columns + column)] |= std::uint64_t{1}
                                                                                  << place;
          }
        }
      }
    }
  }
}

std::uint64_t LightMap::sourcesAt(int face, float a, float b) const {
  const FaceGrid<std::uint64_t>& near = near_[static_cast<std::size_t>(face)];
  const int column =
      std::clamp(static_cast<int>(a * static_cast<float>(near.columns)), 0, near.columns - 1);
  const int row = std::clamp(static_cast<int>(b * static_cast<float>(near.rows)), 0, near.rows - 1);
  return near.values[static_cast<std::size_t>(row * near.columns + column)];
}

void LightMap::bakeBounce(const Geometry& geometry, const RayWorld& world) {
  std::vector<FaceGrid<Rgb>> next = bounced_;
  tbb::parallel_for(std::size_t{0}, geometry.faces.size(), [&](std::size_t f) {
    const Face& face = geometry.faces[f];
    std::uint64_t cell = hashOf(7, f);
    forEachCell(face, next[f], [&](const Vector3f& p, Rgb& value) {
      value = gather(geometry, world, p, face.normal, 64, cell++);
    });
  });
  bounced_ = std::move(next);
}

void LightMap::bakeProbes(const Geometry& geometry, const RayWorld& world, const FloorPlan& plan,
                          const FloorBounds& flat) {
  probe_low_ = flat.low.cast<float>();
  const Vector2f size = (flat.high - flat.low).cast<float>();
  probe_columns_ = cells(size.x(), kProbeStep_m) + 1;
  probe_rows_ = cells(size.y(), kProbeStep_m) + 1;
  probes_.resize(static_cast<std::size_t>(probe_columns_ * probe_rows_));
  tbb::parallel_for(std::size_t{0}, probes_.size(), [&](std::size_t i) {
    const int n = static_cast<int>(i);
    const Vector2f p = probe_low_ + kProbeStep_m * Vector2f(static_cast<float>(n % probe_columns_),
                                                            static_cast<float>(n / probe_columns_));
    Probe& probe = probes_[i];
    probe.valid = plan.clearance(p.cast<double>()) > 0.02;
    for (std::size_t side = 0; side < 6; ++side) {
      Vector3f normal = Vector3f::Zero();
      normal[static_cast<int>(side / 2)] = side % 2 == 0 ? 1.0F : -1.0F;
      probe.light.bounced[side] =
          gather(geometry, world, {p.x(), p.y(), kProbeHeight_m}, normal, 48, hashOf(9, i, side));
    }
    for (std::size_t s = 0; s < std::min(sources_.size(), probe.light.open.size()); ++s) {
      const auto& points = sources_[s].points();
      float seen = 0.0F;
      for (const Vector3f& point : points) {
        for (const float z : {0.6F, 1.1F, 1.6F}) {
          if (!world.blocked({p.x(), p.y(), z}, point, RayTarget::kStill)) seen += 1.0F;
        }
      }
      probe.light.open[s] = seen / static_cast<float>(3 * points.size());
    }
  });
}

Rgb LightMap::gather(const Geometry& geometry, const RayWorld& world, const Vector3f& p,
                     const Vector3f& normal, int rays, std::uint64_t seed) const {
  const float turn = 2.0F * kPi * static_cast<float>(uniformFrom(mixBits(seed)));
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < rays; ++i) {
    const Vector3f direction = cosineDirection(normal, i, rays, turn);
    const RayHit hit = world.trace(p, direction, 50.0F, RayTarget::kStill);
    sum += radianceFrom(geometry, hit, p + hit.distance * direction);
  }
  return sum * (kPi / static_cast<float>(rays));
}

Rgb LightMap::radianceFrom(const Geometry& geometry, const RayHit& hit,
                           const Vector3f& point) const {
  if (hit.kind == RayHit::Kind::kPillar) {
    const Pillar& pillar = geometry.pillars[static_cast<std::size_t>(hit.index)];
    return 0.1F * pillar.tint * geometry.materials[pillar.material].texture.mean();
  }
  if (hit.kind != RayHit::Kind::kFace) return Rgb::Zero();
  const Face& face = geometry.faces[static_cast<std::size_t>(hit.index)];
  if (face.normal.dot(hit.normal) < 0.0F) return Rgb::Zero();  // The inside of something.
  const Material& material = geometry.materials[face.material];
  const Vector3f from = point - face.origin;
  const float a = from.dot(face.edge_u) / face.edge_u.squaredNorm();
  const float b = from.dot(face.edge_v) / face.edge_v.squaredNorm();
  Rgb light = bounced(hit.index, a, b);
  std::uint64_t lit = sourcesAt(hit.index, a, b);
  for (const SourceOnFace& s : sourcesOn(hit.index)) {
    const bool reaches = (lit & 1U) != 0U;
    lit >>= 1U;
    if (!reaches) continue;
    light += s.white.at(a, b) * sources_[static_cast<std::size_t>(s.source)].color();
  }
  // Windows and lamps shine through `sources_`; their own glow would count twice.
  if (material.glow > 0.0F) return Rgb::Zero();
  return light * face.tint * material.texture.mean() / kPi;
}

RoomLight LightMap::inRoom(const Vector3f& p) const {
  const float x = std::clamp((p.x() - probe_low_.x()) / kProbeStep_m, 0.0F,
                             static_cast<float>(probe_columns_ - 1) - 0.001F);
  const float y = std::clamp((p.y() - probe_low_.y()) / kProbeStep_m, 0.0F,
                             static_cast<float>(probe_rows_ - 1) - 0.001F);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  RoomLight light;
  light.bounced.fill(Rgb::Zero());
  float total = 1e-6F;
  std::array<std::pair<const Probe*, float>, 4> corners;
  for (int corner = 0; corner < 4; ++corner) {
    const int i = x0 + corner % 2, j = y0 + corner / 2;
    const Probe& probe = probes_[static_cast<std::size_t>(j * probe_columns_ + i)];
    const float weight =
        (1.0F - std::abs(x - static_cast<float>(i))) * (1.0F - std::abs(y - static_cast<float>(j)));
    corners[static_cast<std::size_t>(corner)] = {&probe, probe.valid ? weight : 0.0F};
    total += probe.valid ? weight : 0.0F;
  }
  const std::size_t sources = std::min(sources_.size(), light.open.size());
  for (const auto& [probe, weight] : corners) {
    if (weight <= 0.0F) continue;
    const float share = weight / total;
    for (std::size_t i = 0; i < 6; ++i) light.bounced[i] += share * probe->light.bounced[i];
    for (std::size_t s = 0; s < sources; ++s) light.open[s] += share * probe->light.open[s];
  }
  return light;
}

Rgb RoomLight::bouncedOn(const Vector3f& normal) const {
  Rgb sum = Rgb::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto side = static_cast<std::size_t>(2 * axis + (normal[axis] < 0.0F ? 1 : 0));
    sum += normal[axis] * normal[axis] * bounced[side];
  }
  return sum;
}

}  // namespace heel
