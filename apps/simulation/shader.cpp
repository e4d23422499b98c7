// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/shader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

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
      shadows_(geometry, world, lights),
      weave_(256,
             [](float u, float v) {
               return Rgb::Constant(0.86F + 0.16F * tileNoise(u, v, 96, 201) +
                                    0.12F * tileNoise(u, v, 24, 202));
             }),
      folds_(256, [](float u, float v) {
        return Rgb::Constant(0.7F + 0.6F * tileFractal(u, v, 5, 3, 203));
      }) {
  for (const Face& face : geometry.faces) {
    const Material& material = geometry.materials[face.material];
    const float width_m = face.edge_u.norm(), height_m = face.edge_v.norm();
    frames_.push_back({face.edge_u / (width_m * width_m), face.edge_v / (height_m * height_m),
                       material.fit_width ? 0.0F : face.texture_u_m / material.tile_m,
                       material.fit_width ? 1.0F : width_m / material.tile_m,
                       material.fit_height ? 1.0F : height_m / material.tile_m,
                       material.fit_height ? height_m : material.tile_m});
  }
}

Rgb Shader::radiance(const ShadedRay& ray, const RayHit& hit, NearbyLight& nearby) const {
  if (nearby.kind != hit.kind || nearby.index != hit.index) {
    nearby.kind = hit.kind;
    nearby.index = hit.index;
    nearby.known = 0;
  }
  const Vector3f p = ray.origin + hit.distance * ray.direction;
  switch (hit.kind) {
    case RayHit::Kind::kFace:
      return faceRadiance(ray, hit, p, nearby);
    case RayHit::Kind::kPillar:
      return pillarRadiance(ray, hit, p, nearby);
    case RayHit::Kind::kBody:
      return bodyRadiance(ray, hit, p, nearby);
    case RayHit::Kind::kNothing:
      break;
  }
  return Rgb::Zero();
}

Rgb Shader::faceRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p,
                         NearbyLight& nearby) const {
  const Face& face = geometry_.faces[static_cast<std::size_t>(hit.index)];
  const FaceFrame& frame = frames_[static_cast<std::size_t>(hit.index)];
  const Material& material = geometry_.materials[face.material];
  const Vector3f from = p - face.origin;
  const float a = from.dot(frame.per_u), b = from.dot(frame.per_v);
  const Rgb albedo =
      face.tint * material.texture.sample(frame.texture_u + a * frame.tiles_u, b * frame.tiles_v,
                                          footprintOf(ray, hit) / frame.tile_m);
  if (material.glow > 0.0F) return material.glow * albedo;
  Rgb light = lights_.still(hit.index, a, b), shine = Rgb::Zero();
  const bool is_glossy = material.gloss > 0.0F;
  const std::uint64_t shaded = shadows_.possible(hit.index, a, b);
  std::uint64_t wanted = is_glossy ? lights_.sourcesNear(hit.index).nearest(a, b) : shaded;
  if (wanted == 0) return albedo * light * kPerPi;

  // Only a source that matters here is asked whether people stand before it.
  const float matters = std::max(kNegligible, kFaintShadow * light.maxCoeff());
  const Vector3f mirrored =
      is_glossy ? Vector3f(ray.direction - 2.0F * ray.direction.dot(face.normal) * face.normal)
                      .normalized()
                : Vector3f::Zero();
  const std::vector<SourceOnFace>& sources = lights_.sourcesOn(hit.index);
  for (std::size_t i = 0; wanted != 0; ++i, wanted >>= 1U) {
    if ((wanted & 1U) == 0U) continue;
    const auto s = static_cast<std::size_t>(sources[i].source);
    const LightSource& source = lights_.sources()[s];
    const std::uint64_t bit = std::uint64_t{1} << i;
    const float glint =
        is_glossy ? highlight(mirrored, source.points()[0] - p, 0.25F * material.gloss_power)
                  : 0.0F;
    if (glint == 0.0F && (shaded & bit) == 0) continue;
    const float white = sources[i].white.at(a, b);
    if (white < matters) continue;
    float seen = 1.0F;
    if ((shaded & bit) != 0) {
      if ((nearby.known & bit) == 0) {
        nearby.seen[i] = shadows_.seen(s, p + kOffSurface_m * face.normal);
        nearby.known |= bit;
      }
      seen = nearby.seen[i];
    }
    light -= (1.0F - seen) * white * source.color();
    shine += seen * white * glint * source.color();
  }
  return albedo * light * kPerPi + material.gloss * shine;
}

Rgb Shader::pillarRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p,
                           NearbyLight& nearby) const {
  const Pillar& pillar = geometry_.pillars[static_cast<std::size_t>(hit.index)];
  const Material& material = geometry_.materials[pillar.material];
  const Vector3f q = p - pillar.base;
  const bool is_end = std::abs(hit.normal.z()) > 0.5F;
  const float u = is_end ? q.x() : std::atan2(q.y(), q.x()) * pillar.radius_m;
  const float v = is_end ? q.y() : q.z();
  const Rgb albedo = pillar.tint * material.texture.sample(u / material.tile_m, v / material.tile_m,
                                                           footprintOf(ray, hit) / material.tile_m);
  if (material.glow > 0.0F) return material.glow * albedo;
  return albedo * lightInRoom(p + kOffSurface_m * hit.normal, hit.normal, nearby) * kPerPi;
}

Rgb Shader::bodyRadiance(const ShadedRay& ray, const RayHit& hit, const Vector3f& p,
                         NearbyLight& nearby) const {
  const BodyPart& part = world_.bodyParts()[static_cast<std::size_t>(hit.index)];
  const Rgb albedo = bodyColor(part, p, footprintOf(ray, hit));
  return albedo * lightInRoom(p + 2.0F * kOffSurface_m * hit.normal, hit.normal, nearby) * kPerPi;
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

Rgb Shader::lightInRoom(const Vector3f& p, const Vector3f& normal, NearbyLight& nearby) const {
  if (nearby.known == 0) nearby.room = lights_.inRoom(p);  // It changes slowly.
  Rgb light = nearby.room.bouncedOn(normal);
  const std::vector<LightSource>& sources = lights_.sources();
  const std::size_t count = std::min(sources.size(), nearby.room.open.size());
  std::array<float, std::tuple_size_v<decltype(RoomLight::open)>> white;
  std::uint64_t wanted = 0;
  for (std::size_t s = 0; s < count; ++s) {
    white[s] = nearby.room.open[s] > 0.0F
                   ? nearby.room.open[s] * sources[s].irradianceOnBody(p, normal)
                   : 0.0F;
    if (white[s] >= 3.0F * kNegligible) wanted |= std::uint64_t{1} << s;
  }
  shadows_.lookFromBody(p, wanted & ~nearby.known, nearby.seen);
  nearby.known |= wanted;
  for (std::size_t s = 0; s < count; ++s) {
    if ((wanted >> s & 1U) != 0U) light += nearby.seen[s] * white[s] * sources[s].color();
  }
  return light;
}

}  // namespace heel
