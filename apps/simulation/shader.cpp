// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/shader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector3f;

constexpr float kPi = 3.14159265F;
constexpr float kOffSurface_m = 0.003F;
constexpr float kNegligible = 2e-3F;  // Irradiance that no picture shows.

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

/// A highlight of Blinn's form, with about the same energy for all powers.
float highlight(const Vector3f& to_light, const Vector3f& to_eye, const Vector3f& normal,
                float power) {
  const float cosine = normal.dot((to_light + to_eye).normalized());
  if (cosine < 1.0F - 6.0F / power) return 0.0F;  // Under a three-hundredth of the peak.
  return std::pow(cosine, power) * (power + 8.0F) / (8.0F * kPi);
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
  Rgb light = lights_.bounced(hit.index, a, b);
  Rgb shine = Rgb::Zero();
  const bool share = share_shadow && shadow.face == hit.index;
  shadow.face = hit.index;
  std::size_t place = 0;
  for (const SourceOnFace& s : lights_.sourcesOn(hit.index)) {
    float& seen = shadow.seen[place++ % shadow.seen.size()];
    float white = s.white.at(a, b);
    if (white < kNegligible && !share) seen = 1.0F;
    if (white < kNegligible) continue;
    const LightSource& source = lights_.sources()[static_cast<std::size_t>(s.source)];
    if (!share) seen = notShaded(source, p + kOffSurface_m * face.normal);
    white *= seen;
    light += white * source.color();
    if (material.gloss > 0.0F) {
      shine += white * source.color() *
               highlight((source.points()[0] - p).normalized(), -ray.direction.normalized(),
                         hit.normal, material.gloss_power);
    }
  }
  return albedo * light / kPi + material.gloss * shine;
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
  return albedo * lightInRoom(p + kOffSurface_m * hit.normal, hit.normal) / kPi;
}

Rgb Shader::bodyRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p) const {
  const BodyPart& part = world_.bodyParts()[static_cast<std::size_t>(hit.index)];
  const Rgb albedo = bodyColor(part, p, footprintOf(ray, hit));
  return albedo * lightInRoom(p + 2.0F * kOffSurface_m * hit.normal, hit.normal) / kPi;
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
    // Two of a source's points are enough for the rounded shapes of bodies.
    for (std::size_t i = 0; i < 2; ++i) {
      const float white = room.open[s] * 0.5F * static_cast<float>(sources[s].points().size()) *
                          sources[s].irradiance(i, p, normal);
      if (white < kNegligible) continue;
      points[static_cast<std::size_t>(count)] = sources[s].points()[i];
      falling[static_cast<std::size_t>(count++)] = white * sources[s].color();
      if (count == RayWorld::kPacket) add_what_arrives();
    }
  }
  if (count > 0) add_what_arrives();
  return light;
}

float Shader::notShaded(const LightSource& source, const Vector3f& p) const {
  if (!world_.peopleNear(p, source.center(), source.reach_m())) return 1.0F;
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
