// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/light_map.hpp>
#include <heel/apps/simulation/random.hpp>

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
constexpr float kNearCell_m = 0.5F;
constexpr float kProbeStep_m = 0.5F;
constexpr float kProbeHeight_m = 1.1F;
constexpr float kOffSurface_m = 0.002F;
constexpr float kNegligible = 2e-3F;

int probesAlong(float length_m) {
  return std::clamp(static_cast<int>(std::ceil(length_m / kProbeStep_m)), 1, 400) + 1;
}

/// A place on a face, a little off it.
Vector3f pointOn(const Face& face, float a, float b) {
  return face.origin + a * face.edge_u + b * face.edge_v + kOffSurface_m * face.normal;
}

/// What falls from a source on a place, past all that stands still.
float arriving(const LightSource& source, const RayWorld& world, const Vector3f& p,
               const Vector3f& normal) {
  std::array<Vector3f, RayWorld::kShadowPacket> points;
  std::array<float, RayWorld::kShadowPacket> falls;
  std::size_t count = 0;
  for (std::size_t i = 0; i < source.points().size(); ++i) {
    falls[count] = source.irradiance(i, p, normal);
    if (falls[count] * static_cast<float>(source.points().size()) < kNegligible) continue;
    points[count++] = source.points()[i];
  }
  if (count == 0) return 0.0F;
  const unsigned hidden =
      world.blocked(p, points.data(), static_cast<int>(count), RayTarget::kStill);
  float sum = 0.0F;
  for (std::size_t i = 0; i < count; ++i) sum += (hidden >> i & 1U) == 0U ? falls[i] : 0.0F;
  return sum;
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
  bakeDirect(geometry, world);
  noteSources(geometry);
  sumUp(geometry, {});
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
      forEachCell(light.white, [&](float a, float b, float& value) {
        const Vector3f p = pointOn(face, a, b);
        value = arriving(source, world, p, face.normal);
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

void LightMap::bakeBounce(const Geometry& geometry, const RayWorld& world) {
  std::vector<FaceGrid<Rgb>> bounced(geometry.faces.size());
  tbb::parallel_for(std::size_t{0}, geometry.faces.size(), [&](std::size_t f) {
    const Face& face = geometry.faces[f];
    bounced[f] = gridOver<Rgb>(face, kBounceCell_m, Rgb::Zero());
    std::uint64_t cell = hashOf(7, f);
    forEachCell(bounced[f], [&](float a, float b, Rgb& value) {
      value = gather(geometry, world, pointOn(face, a, b), face.normal, 64, cell++);
    });
  });
  sumUp(geometry, bounced);
}

void LightMap::sumUp(const Geometry& geometry, const std::vector<FaceGrid<Rgb>>& bounced) {
  still_.resize(geometry.faces.size());
  tbb::parallel_for(std::size_t{0}, geometry.faces.size(), [&](std::size_t f) {
    still_[f] = gridOver<Eigen::Array4f>(geometry.faces[f], kDirectCell_m, Eigen::Array4f::Zero());
    std::size_t cell = 0;
    forEachCell(still_[f], [&](float a, float b, Eigen::Array4f& value) {
      if (!bounced.empty()) value.head<3>() = bounced[f].at(a, b);
      for (const SourceOnFace& light : direct_[f]) {
        const LightSource& source = sources_[static_cast<std::size_t>(light.source)];
        value.head<3>() += light.white.values[cell] * source.color();
      }
      ++cell;
    });
  });
}

void LightMap::bakeProbes(const Geometry& geometry, const RayWorld& world, const FloorPlan& plan,
                          const FloorBounds& flat) {
  probe_low_ = flat.low.cast<float>();
  const Vector2f size = (flat.high - flat.low).cast<float>();
  probe_columns_ = probesAlong(size.x());
  probe_rows_ = probesAlong(size.y());
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
  // Windows and lamps shine through `sources_`; their own glow would count twice.
  if (material.glow > 0.0F) return Rgb::Zero();
  return still(hit.index, a, b) * face.tint * material.texture.mean() / kPi;
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
