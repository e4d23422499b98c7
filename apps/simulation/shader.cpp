// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/shader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace heel {
namespace {

using Eigen::Vector3f;

constexpr float kPi = 3.14159265F;
constexpr float kPerPi = 1.0F / kPi;
constexpr float kOffSurface_m = 0.003F;
constexpr float kFaintShadow = 0.04F;  // Share of the light that is not missed.
constexpr float kNegligible = 2e-3F;   // Irradiance that no picture shows.

/// How much of a pixel is on odd stripes: a square wave of period 2, averaged over `footprint`.
float stripeShare(float x, float footprint) {
  const float phase = x - 2.0F * std::floor(x / 2.0F);  // [0, 2)
  const bool odd = phase >= 1.0F;
  const float to_edge = 0.5F - std::abs(phase - (odd ? 1.5F : 0.5F));
  const float from_edge = odd ? to_edge : -to_edge;
  const float share = std::clamp(0.5F + from_edge / std::max(footprint, 1e-3F), 0.0F, 1.0F);
  const float blurred = std::clamp(footprint - 1.0F, 0.0F, 1.0F);  // Stripes finer than a pixel.
  return share + (0.5F - share) * blurred;
}

/// A highlight of Phong's form, with about the same energy for all powers.
/// @param mirrored  Where the eye's ray goes on to, unit length.
float highlight(const Vector3f& mirrored, const Vector3f& to_light, float power) {
  const float along = mirrored.dot(to_light);
  const float square = to_light.squaredNorm();
  const float least = 1.0F - 6.0F / power;  // A three-hundredth of the peak is not worth a root.
  if (along <= 0.0F || along * along < least * std::abs(least) * square) return 0.0F;
  return std::pow(along / std::sqrt(square), power) * (power + 2.0F) / (2.0F * kPi);
}

float footprintOf(const ShadedRay& ray, const RayHit& hit) {
  const float length = ray.direction.norm();
  const float cosine = std::abs(ray.direction.dot(hit.normal)) / length;
  return hit.distance * length * ray.pixel_rad / std::sqrt(std::max(cosine, 0.04F));
}

}  // namespace

Shader::Shader(const Scene& scene, const Geometry& geometry, const RayWorld& world,
               const LightMap& lights)
    : scene_(scene),
      geometry_(geometry),
      world_(world),
      lights_(lights),
      weave_(256,
             [](float u, float v) {
               return Rgb::Constant(0.86F + 0.16F * tileNoise(u, v, 96, 201) +
                                    0.12F * tileNoise(u, v, 24, 202));
             }),
      folds_(256, [](float u, float v) {
        return Rgb::Constant(0.7F + 0.6F * tileFractal(u, v, 5, 3, 203));
      }) {
  for (const Face& face : geometry.faces) {
    frames_.push_back({face.edge_u / face.edge_u.squaredNorm(),
                       face.edge_v / face.edge_v.squaredNorm(), face.edge_u.norm(),
                       face.edge_v.norm()});
  }
  peopleHaveMoved();
}

Rgb Shader::radiance(const ShadedRay& ray, const RayHit& hit, NearbyShadow& shadow,
                     bool share_shadow) const {
  const Vector3f p = ray.origin + hit.distance * ray.direction;
  switch (hit.kind) {
    case RayHit::Kind::kFace:
      return faceRadiance(ray, hit, p, shadow, share_shadow);
    case RayHit::Kind::kPillar:
      return pillarRadiance(ray, hit, p);
    case RayHit::Kind::kBody:
      return bodyRadiance(ray, hit, p);
    case RayHit::Kind::kNothing:
      break;
  }
  return Rgb::Zero();
}

Rgb Shader::faceRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p,
                         NearbyShadow& shadow, bool share_shadow) const {
  const Face& face = geometry_.faces[static_cast<std::size_t>(hit.index)];
  const FaceFrame& frame = frames_[static_cast<std::size_t>(hit.index)];
  const Material& material = geometry_.materials[face.material];
  const Vector3f from = p - face.origin;
  const float a = from.dot(frame.per_u), b = from.dot(frame.per_v);
  const float u =
      material.fit_width ? a : (face.texture_u_m + a * frame.length_u) / material.tile_m;
  const float v = material.fit_height ? b : b * frame.length_v / material.tile_m;
  const float tile_m = material.fit_height ? frame.length_v : material.tile_m;
  const Rgb albedo = face.tint * material.texture.sample(u, v, footprintOf(ray, hit) / tile_m);
  if (material.glow > 0.0F) return material.glow * albedo;
  const std::vector<SourceOnFace>& sources = lights_.sourcesOn(hit.index);
  const std::uint64_t lit = lights_.sourcesAt(hit.index, a, b);
  std::array<float, 64> white;
  Rgb light = lights_.bounced(hit.index, a, b);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    white[i] = (lit >> i & 1U) != 0U ? sources[i].white.at(a, b) : 0.0F;
    if (white[i] > kNegligible)
      light += white[i] * lights_.sources()[static_cast<std::size_t>(sources[i].source)].color();
  }
  // Only a source that matters here is asked whether people stand before it.
  const float matters = std::max(kNegligible, kFaintShadow * light.maxCoeff());
  const bool share = share_shadow && shadow.face == hit.index;
  shadow.face = hit.index;
  Rgb shine = Rgb::Zero();
  const Vector3f mirrored =
      (ray.direction - 2.0F * ray.direction.dot(face.normal) * face.normal).normalized();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    float& seen = shadow.seen[i];
    if (!share) seen = 1.0F;
    if (white[i] < matters) continue;
    const auto s = static_cast<std::size_t>(sources[i].source);
    const LightSource& source = lights_.sources()[s];
    if (!share) seen = notShaded(s, p + kOffSurface_m * face.normal);
    if (seen < 1.0F) light -= (1.0F - seen) * white[i] * source.color();
    if (material.gloss > 0.0F && seen > 0.0F) {
      shine += seen * white[i] * source.color() *
               highlight(mirrored, source.points()[0] - p, 0.25F * material.gloss_power);
    }
  }
  return albedo * light * kPerPi + material.gloss * shine;
}

Rgb Shader::pillarRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p) const {
  const Pillar& pillar = geometry_.pillars[static_cast<std::size_t>(hit.index)];
  const Material& material = geometry_.materials[pillar.material];
  const Vector3f q = p - pillar.base;
  const bool is_end = std::abs(hit.normal.z()) > 0.5F;
  const float u = is_end ? q.x() : std::atan2(q.y(), q.x()) * pillar.radius_m;
  const float v = is_end ? q.y() : q.z();
  const Rgb albedo = pillar.tint * material.texture.sample(u / material.tile_m, v / material.tile_m,
                                                           footprintOf(ray, hit) / material.tile_m);
  if (material.glow > 0.0F) return material.glow * albedo;
  return albedo * lightInRoom(p + kOffSurface_m * hit.normal, hit.normal) * kPerPi;
}

Rgb Shader::bodyRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p) const {
  const BodyPart& part = world_.bodyParts()[static_cast<std::size_t>(hit.index)];
  const Rgb albedo = bodyColor(part, p, footprintOf(ray, hit));
  return albedo * lightInRoom(p + 2.0F * kOffSurface_m * hit.normal, hit.normal) * kPerPi;
}

Rgb Shader::bodyColor(const BodyPart& part, const Vector3f& p, float footprint_m) const {
  const Outfit& outfit = scene_.people[static_cast<std::size_t>(part.person)].outfit;
  const Vector3f q = part.cloth_from_world * p;
  const float u = std::atan2(q.y(), q.x()) * std::hypot(q.x(), q.y()), v = q.z();
  const float fine = weave_.sample(u * 5.0F, v * 5.0F, footprint_m * 5.0F)[0];
  switch (part.cover) {
    case BodyCover::kSkin:
      return outfit.skin * (0.75F + 0.25F * fine);
    case BodyCover::kHair:
      return outfit.hair * (0.2F + weave_.sample(u * 12.0F, v, 12.0F * footprint_m)[0]);
    case BodyCover::kShoes:
      return outfit.shoes * fine;
    case BodyCover::kTop:
    case BodyCover::kTrousers:
      break;
  }
  const Garment& garment = part.cover == BodyCover::kTop ? outfit.top : outfit.trousers;
  const Cloth& cloth = garment.back && q.x() < 0.0F ? *garment.back : garment.front;
  const float fold = folds_.sample(u * 2.0F, v * 1.2F + 0.37F * static_cast<float>(part.person),
                                   footprint_m * 2.0F)[0];
  return clothColor(cloth, u, v, footprint_m) * (fine * fold);
}

Rgb Shader::clothColor(const Cloth& cloth, float u, float v, float footprint_m) const {
  if (cloth.pattern == Cloth::Pattern::kPlain) return cloth.color;
  const auto width = static_cast<float>(cloth.width_m);
  const float across = stripeShare(v / width, footprint_m / width);
  if (cloth.pattern == Cloth::Pattern::kStripes) {
    return cloth.color + across * (cloth.second - cloth.color);
  }
  const float along = stripeShare(u / width, footprint_m / width);
  // Woven checks: where both threads have the second colour it is full, where one has it, half.
  return cloth.color + 0.5F * (across + along) * (cloth.second - cloth.color);
}

Rgb Shader::lightInRoom(const Vector3f& p, const Vector3f& normal) const {
  const RoomLight room = lights_.inRoom(p);
  Rgb light = room.bouncedOn(normal);
  std::array<Vector3f, RayWorld::kPacket> points;
  std::array<Rgb, RayWorld::kPacket> falling;
  int count = 0;
  const auto add_what_arrives = [&] {
    const unsigned hidden = world_.blocked(p, points.data(), count, RayTarget::kPeople);
    for (int i = 0; i < count; ++i) {
      const bool seen = (hidden >> static_cast<unsigned>(i) & 1U) == 0U;
      if (seen) light += falling[static_cast<std::size_t>(i)];
    }
    count = 0;
  };
  const std::vector<LightSource>& sources = lights_.sources();
  for (std::size_t s = 0; s < std::min(sources.size(), room.open.size()); ++s) {
    // A few of a source's points are enough for the rounded shapes of bodies.
    const std::size_t some = sources[s].pointsForBodies();
    const float share =
        room.open[s] * static_cast<float>(sources[s].points().size()) / static_cast<float>(some);
    for (std::size_t i = 0; i < some; ++i) {
      const float white = share * sources[s].irradiance(i, p, normal);
      if (white < 3.0F * kNegligible) continue;
      points[static_cast<std::size_t>(count)] = sources[s].points()[i];
      falling[static_cast<std::size_t>(count++)] = white * sources[s].color();
      if (count == RayWorld::kPacket) add_what_arrives();
    }
  }
  if (count > 0) add_what_arrives();
  return light;
}

void Shader::peopleHaveMoved() {
  lit_people_.assign(lights_.sources().size(), 0);
  const std::vector<PersonBounds>& people = world_.people();
  for (std::size_t i = 0; i < people.size(); ++i) {
    // Whom no light of a lamp reaches throws no shadow of it. Beyond 63 people all share one bit.
    const std::uint64_t bit = std::uint64_t{1} << std::min(i, std::size_t{63});
    const RoomLight room = lights_.inRoom({people[i].center.x(), people[i].center.y(), 1.0F});
    for (std::size_t s = 0; s < lit_people_.size(); ++s) {
      if (s >= room.open.size() || room.open[s] > 0.0F) lit_people_[s] |= bit;
    }
  }
}

float Shader::notShaded(std::size_t source_index, const Vector3f& p) const {
  const std::uint64_t who = lit_people_[source_index];
  const LightSource& source = lights_.sources()[source_index];
  if (who == 0 || !world_.peopleNear(p, source.center(), source.reach_m(), who)) return 1.0F;
  // Some of the points first; the others only where those do not agree (at a shadow's soft edge).
  const std::vector<Vector3f>& points = source.points();
  const int all = static_cast<int>(points.size()), some = source.firstPoints();
  int seen = countSeen(p, points.data(), some);
  if (seen == 0) return 0.0F;
  if (seen == some) return 1.0F;
  seen += countSeen(p, points.data() + some, all - some);
  return static_cast<float>(seen) / static_cast<float>(all);
}

int Shader::countSeen(const Vector3f& p, const Vector3f* points, int count) const {
  unsigned hidden = world_.blocked(p, points, count, RayTarget::kPeople);
  int seen = count;
  for (; hidden != 0U; hidden &= hidden - 1U) --seen;
  return seen;
}

}  // namespace heel
