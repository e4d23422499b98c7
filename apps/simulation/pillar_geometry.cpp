// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/pillar_geometry.hpp>

#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector3f;

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

}  // namespace

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

}  // namespace heel
