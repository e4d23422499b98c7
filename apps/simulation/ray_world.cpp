// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/embree.hpp>
#include <heel/apps/simulation/ray_world.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

namespace {

using Eigen::Vector3f;

constexpr unsigned kFaceId = 0, kPillarId = 1, kBodyId = 2;

/// One thread builds a tree of a few hundred shapes, so that the tree does not depend on how many
/// threads there are.
void commit(RTCScene scene) {
  tbb::task_arena one_thread(1);
  one_thread.execute([scene] { rtcCommitScene(scene); });
}

// Upright cylinders: Embree has none with flat ends.

/// The nearest distance in (near, far) at which a ray enters or leaves a pillar; < 0 if none.
float hitPillar(const Pillar& pillar, const Vector3f& origin, const Vector3f& direction, float near,
                float far, Vector3f& normal) {
  const Vector3f o = origin - pillar.base;
  const float a = direction.x() * direction.x() + direction.y() * direction.y();
  const float b = o.x() * direction.x() + o.y() * direction.y();
  const float c = o.x() * o.x() + o.y() * o.y() - pillar.radius_m * pillar.radius_m;
  float best = -1.0F;
  const auto offer = [&](float t, const Vector3f& n) {
    if (t > near && t < far && (best < 0.0F || t < best)) {
      best = t;
      normal = n;
    }
  };
  const float root = b * b - a * c;
  if (a > 0.0F && root > 0.0F) {
    for (const float sign : {-1.0F, 1.0F}) {
      const float t = (-b + sign * std::sqrt(root)) / a;
      const float z = o.z() + t * direction.z();
      if (z < 0.0F || z > pillar.height_m) continue;
      offer(t, {(o.x() + t * direction.x()) / pillar.radius_m,
                (o.y() + t * direction.y()) / pillar.radius_m, 0.0F});
    }
  }
  if (direction.z() != 0.0F) {
    for (const float end : {0.0F, 1.0F}) {
      const float t = (end * pillar.height_m - o.z()) / direction.z();
      const float x = o.x() + t * direction.x(), y = o.y() + t * direction.y();
      if (x * x + y * y > pillar.radius_m * pillar.radius_m) continue;
      offer(t, {0.0F, 0.0F, 2.0F * end - 1.0F});
    }
  }
  return best;
}

float hitPillarLane(const Pillar& pillar, RTCRayN* ray, unsigned n, unsigned i, Vector3f& normal) {
  return hitPillar(pillar,
                   {RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)},
                   {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)},
                   RTCRayN_tnear(ray, n, i), RTCRayN_tfar(ray, n, i), normal);
}

void bounds(const RTCBoundsFunctionArguments* args) {
  const Pillar& p = static_cast<const Pillar*>(args->geometryUserPtr)[args->primID];
  RTCBounds& box = *args->bounds_o;
  box.lower_x = p.base.x() - p.radius_m;
  box.lower_y = p.base.y() - p.radius_m;
  box.lower_z = p.base.z();
  box.upper_x = p.base.x() + p.radius_m;
  box.upper_y = p.base.y() + p.radius_m;
  box.upper_z = p.base.z() + p.height_m;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  const Pillar& pillar = static_cast<const Pillar*>(args->geometryUserPtr)[args->primID];
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    Vector3f normal;
    const float t = hitPillarLane(pillar, ray, args->N, i, normal);
    if (t < 0.0F) continue;
    RTCRayN_tfar(ray, args->N, i) = t;
    RTCHitN_Ng_x(hit, args->N, i) = normal.x();
    RTCHitN_Ng_y(hit, args->N, i) = normal.y();
    RTCHitN_Ng_z(hit, args->N, i) = normal.z();
    RTCHitN_geomID(hit, args->N, i) = args->geomID;
    RTCHitN_primID(hit, args->N, i) = args->primID;
  }
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  const Pillar& pillar = static_cast<const Pillar*>(args->geometryUserPtr)[args->primID];
  for (unsigned i = 0; i < args->N; ++i) {
    Vector3f normal;
    if (args->valid[i] == 0 || hitPillarLane(pillar, args->ray, args->N, i, normal) < 0.0F)
      continue;
    RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

/// Of pillars that outlive it.
RTCGeometry makePillarGeometry(RTCDevice device, const std::vector<Pillar>& pillars) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(pillars.size()));
  // Embree hands the pointer back to the functions above, which only read from it.
  rtcSetGeometryUserData(geometry, const_cast<Pillar*>(pillars.data()));
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry makeFaceGeometry(RTCDevice device, const std::vector<Face>& faces) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * faces.size()));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), faces.size()));
  unsigned next = 0;
  for (const Face& face : faces) {
    for (const Vector3f& corner :
         {face.origin, Vector3f(face.origin + face.edge_u),
          Vector3f(face.origin + face.edge_u + face.edge_v), Vector3f(face.origin + face.edge_v)}) {
      for (int i = 0; i < 3; ++i) *vertex++ = corner[i];
      *index++ = next++;
    }
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

/// Tapered capsules, each a curve of one straight segment.
RTCGeometry makeBodyGeometry(RTCDevice device, const std::vector<BodyPart>& parts) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * parts.size()));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), parts.size()));
  unsigned next = 0;
  for (const BodyPart& part : parts) {
    for (int i = 0; i < 3; ++i) *vertex++ = part.a[i];
    *vertex++ = part.radius_a;
    for (int i = 0; i < 3; ++i) *vertex++ = part.b[i];
    *vertex++ = part.radius_b;
    *index++ = next;
    next += 2;
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id) {
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

RayHit makeHit(const std::vector<Face>& faces, unsigned geometry, unsigned primitive,
               float distance, const Vector3f& normal, const Vector3f& direction) {
  RayHit hit;
  if (geometry == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.kind = geometry == kFaceId     ? RayHit::Kind::kFace
             : geometry == kPillarId ? RayHit::Kind::kPillar
                                     : RayHit::Kind::kBody;
  hit.index = static_cast<int>(primitive);
  hit.distance = distance;
  // The normal of a face is known; those of round shapes come from the hit.
  const Vector3f unit =
      hit.kind == RayHit::Kind::kFace ? faces[primitive].normal : Vector3f(normal.normalized());
  hit.normal = unit.dot(direction) > 0.0F ? Vector3f(-unit) : unit;
  return hit;
}

std::vector<PersonBounds> surround(const std::vector<BodyPart>& parts) {
  std::vector<PersonBounds> out;
  int person = -1;
  for (const BodyPart& part : parts) {  // The first parts of a body are near its middle.
    if (part.person != person) out.push_back({part.a.head<2>(), 0.0F, 0.0F});
    person = part.person;
    PersonBounds& around = out.back();
    for (const auto& [end, radius] : {std::pair(part.a, part.radius_a), {part.b, part.radius_b}}) {
      const float reach = (end.head<2>() - around.center).norm() + radius;
      around.radius_m = std::max(around.radius_m, reach);
      around.top_m = std::max(around.top_m, end.z() + radius);
    }
  }
  return out;
}

float cross(const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether rays from `origin` may meet a person, as seen from above; quick, and never false where
/// one does.
bool mayMeet(const std::vector<PersonBounds>& people, const Vector3f& origin,
             const Vector3f* directions, int count) {
  if (people.empty()) return false;
  const Eigen::Vector2f first = directions[0].head<2>();
  Eigen::Vector2f left = first, right = first;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2f flat = directions[i].head<2>();
    if (flat.dot(first) <= 0.0F) return true;  // All around, or straight up: no sides to speak of.
    if (cross(left, flat) > 0.0F) left = flat;
    if (cross(right, flat) < 0.0F) right = flat;
  }
  left.normalize();
  right.normalize();
  const Eigen::Vector2f middle = (left + right).normalized();
  const float half = (left - middle).norm() * 1.1F;
  if (!(half < 0.5F)) return true;
  for (const PersonBounds& person : people) {
    const Eigen::Vector2f to = person.center - origin.head<2>();
    const float reach = person.radius_m + half * to.norm();
    if (to.dot(middle) > -reach && std::abs(cross(middle, to)) < reach) return true;
  }
  return false;
}

}  // namespace

struct RayWorld::Scenes {
  explicit Scenes(const Geometry& geometry) : faces(geometry.faces), device(rtcNewDevice(nullptr)) {
    if (device == nullptr) throw std::runtime_error("Embree can't start on this machine");
    still = rtcNewScene(device);
    rtcSetSceneBuildQuality(still, RTC_BUILD_QUALITY_HIGH);
    attach(still, makeFaceGeometry(device, geometry.faces), kFaceId);
    if (!geometry.pillars.empty()) {
      attach(still, makePillarGeometry(device, geometry.pillars), kPillarId);
    }
    commit(still);
    people = rtcNewScene(device);
    commit(people);
  }
  ~Scenes() {
    rtcReleaseScene(people);
    rtcReleaseScene(still);
    rtcReleaseDevice(device);
  }
  Scenes(const Scenes&) = delete;
  Scenes& operator=(const Scenes&) = delete;

  const std::vector<Face>& faces;
  RTCDevice device;
  RTCScene still = nullptr;
  RTCScene people = nullptr;
  std::vector<BodyPart> parts;
  std::vector<PersonBounds> around;
};

RayWorld::RayWorld(const Geometry& geometry) : scenes_(std::make_unique<Scenes>(geometry)) {}
RayWorld::~RayWorld() = default;
RayWorld::RayWorld(RayWorld&&) noexcept = default;
RayWorld& RayWorld::operator=(RayWorld&&) noexcept = default;

const std::vector<BodyPart>& RayWorld::bodyParts() const { return scenes_->parts; }

void RayWorld::setPeople(std::vector<BodyPart> parts) {
  scenes_->parts = std::move(parts);
  scenes_->around = surround(scenes_->parts);
  rtcReleaseScene(scenes_->people);
  scenes_->people = rtcNewScene(scenes_->device);
  if (!scenes_->parts.empty()) {
    attach(scenes_->people, makeBodyGeometry(scenes_->device, scenes_->parts), kBodyId);
  }
  commit(scenes_->people);
}

RayHit RayWorld::trace(const Vector3f& origin, const Vector3f& direction, float max_distance,
                       RayTarget target) const {
  RTCRayHit ray{};
  ray.ray.org_x = origin.x();
  ray.ray.org_y = origin.y();
  ray.ray.org_z = origin.z();
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tfar = max_distance;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (target != RayTarget::kPeople) intersect1(scenes_->still, ray);
  if (target != RayTarget::kStill) intersect1(scenes_->people, ray);
  return makeHit(scenes_->faces, ray.hit.geomID, ray.hit.primID, ray.ray.tfar,
                 {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}, direction);
}

void RayWorld::trace(const Vector3f& origin, const Vector3f* directions, int count,
                     std::array<RayHit, kPacket>& hits) const {
  RTCRayHit16 rays;
  alignas(64) int valid[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    valid[i] = i < count ? -1 : 0;
    const Vector3f& direction = directions[i < count ? i : 0];
    rays.ray.org_x[i] = origin.x();
    rays.ray.org_y[i] = origin.y();
    rays.ray.org_z[i] = origin.z();
    rays.ray.dir_x[i] = direction.x();
    rays.ray.dir_y[i] = direction.y();
    rays.ray.dir_z[i] = direction.z();
    rays.ray.tnear[i] = rays.ray.time[i] = 0.0F;
    rays.ray.tfar[i] = 1e9F;
    rays.ray.mask[i] = ~0U;
    rays.ray.id[i] = rays.ray.flags[i] = 0U;
    rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  intersect16(valid, scenes_->still, rays);
  if (mayMeet(scenes_->around, origin, directions, count)) {
    intersect16(valid, scenes_->people, rays);
  }
  for (int i = 0; i < count; ++i) {
    hits[static_cast<std::size_t>(i)] =
        makeHit(scenes_->faces, rays.hit.geomID[i], rays.hit.primID[i], rays.ray.tfar[i],
                {rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]}, directions[i]);
  }
}

bool RayWorld::blocked(const Vector3f& from, const Vector3f& to, RayTarget target) const {
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = to.x() - from.x();
  ray.dir_y = to.y() - from.y();
  ray.dir_z = to.z() - from.z();
  ray.tfar = 1.0F;
  ray.mask = ~0U;
  if (target != RayTarget::kPeople) occluded1(scenes_->still, ray);
  if (target != RayTarget::kStill && ray.tfar >= 0.0F && !scenes_->parts.empty()) {
    occluded1(scenes_->people, ray);
  }
  return ray.tfar < 0.0F;
}

unsigned RayWorld::blocked(const Vector3f& from, const Vector3f* to, int count,
                           RayTarget target) const {
  RTCRay8 rays;
  alignas(32) int valid[kShadowPacket];
  for (int i = 0; i < kShadowPacket; ++i) {
    valid[i] = i < count ? -1 : 0;
    const Vector3f direction = to[i < count ? i : 0] - from;
    rays.org_x[i] = from.x();
    rays.org_y[i] = from.y();
    rays.org_z[i] = from.z();
    rays.dir_x[i] = direction.x();
    rays.dir_y[i] = direction.y();
    rays.dir_z[i] = direction.z();
    rays.tnear[i] = rays.time[i] = 0.0F;
    rays.tfar[i] = 1.0F;
    rays.mask[i] = ~0U;
    rays.id[i] = rays.flags[i] = 0U;
  }
  if (target != RayTarget::kStill && !scenes_->parts.empty()) {
    occluded8(valid, scenes_->people, rays);
  }
  if (target != RayTarget::kPeople) {
    for (int i = 0; i < count; ++i) valid[i] = rays.tfar[i] < 0.0F ? 0 : -1;
    occluded8(valid, scenes_->still, rays);
  }
  unsigned hidden = 0;
  for (int i = 0; i < count; ++i)
    hidden |= rays.tfar[i] < 0.0F ? 1U << static_cast<unsigned>(i) : 0U;
  return hidden;
}

const std::vector<PersonBounds>& RayWorld::people() const { return scenes_->around; }

bool RayWorld::peopleNear(const Vector3f& from, const Vector3f& to, float margin_m,
                          std::uint64_t who) const {
  const Eigen::Vector2f start = from.head<2>(), along = to.head<2>() - start;
  const float square = std::max(along.squaredNorm(), 1e-12F);
  for (const PersonBounds& around : scenes_->around) {
    const bool counts = (who & 1U) != 0U;
    who = who >> 1U | (who & std::uint64_t{1} << 63U);
    if (!counts) continue;
    const float reach = around.radius_m + margin_m;
    const float t = std::clamp((around.center - start).dot(along) / square, 0.0F, 1.0F);
    if ((start + t * along - around.center).squaredNorm() > reach * reach) continue;
    // The lowest place where the line can be over the person.
    const float spread = reach / std::sqrt(square);
    const float low =
        from.z() +
        (to.z() - from.z()) * std::clamp(to.z() > from.z() ? t - spread : t + spread, 0.0F, 1.0F);
    if (low < around.top_m + margin_m) return true;
  }
  return false;
}

}  // namespace heel
