// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/people_shadows.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector3f;

}  // namespace

PeopleShadows::PeopleShadows(const Geometry& geometry, const RayWorld& world,
                             const LightMap& lights)
    : geometry_(geometry), world_(world), lights_(lights) {
  for (std::size_t f = 0; f < geometry.faces.size(); ++f) {
    possible_.push_back(lights.sourcesNear(static_cast<int>(f)));
  }
  update();
}

void PeopleShadows::update() {
  noteWhoIsLit();
  for (std::size_t f = 0; f < possible_.size(); ++f) {
    const Face& face = geometry_.faces[f];
    const std::vector<SourceOnFace>& sources = lights_.sourcesOn(static_cast<int>(f));
    const FaceGrid<std::uint64_t>& lit = lights_.sourcesNear(static_cast<int>(f));
    const float cell_reach_m =
        0.5F * std::hypot(face.edge_u.norm() / static_cast<float>(lit.columns),
                          face.edge_v.norm() / static_cast<float>(lit.rows));
    auto lit_here = lit.values.begin();
    forEachCell(possible_[f], [&](float a, float b, std::uint64_t& possible) {
      const std::uint64_t sources_here = *lit_here++;
      const Vector3f middle = face.origin + a * face.edge_u + b * face.edge_v;
      possible = 0;
      for (std::size_t i = 0; i < sources.size(); ++i) {
        const std::uint64_t bit = std::uint64_t{1} << i;
        const auto s = static_cast<std::size_t>(sources[i].source);
        if ((sources_here & bit) == 0 || lit_people_[s] == 0) continue;
        const LightSource& source = lights_.sources()[s];
        const float margin_m = std::max(source.reach_m(), cell_reach_m);
        if (world_.peopleNear(middle, source.center(), margin_m, lit_people_[s])) possible |= bit;
      }
    });
  }
}

void PeopleShadows::noteWhoIsLit() {
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

float PeopleShadows::seen(std::size_t source_index, const Vector3f& p) const {
  const LightSource& source = lights_.sources()[source_index];
  const std::uint64_t who = lit_people_[source_index];
  if (!world_.peopleNear(p, source.center(), source.reach_m(), who)) return 1.0F;
  // Some of the points first; the others only where those do not agree (at a shadow's soft edge).
  const std::vector<Vector3f>& points = source.points();
  const int all = static_cast<int>(points.size()), some = source.firstPoints();
  int seen = countSeen(p, points.data(), some);
  if (seen == 0) return 0.0F;
  if (seen == some) return 1.0F;
  seen += countSeen(p, points.data() + some, all - some);
  return static_cast<float>(seen) / static_cast<float>(all);
}

void PeopleShadows::lookFromBody(const Vector3f& p, std::uint64_t sources,
                                 std::array<float, 64>& shares) const {
  std::array<Vector3f, RayWorld::kShadowPacket> points;
  std::array<std::size_t, RayWorld::kShadowPacket> source_of;
  std::size_t count = 0;
  const auto look = [&] {
    const unsigned hidden =
        world_.blocked(p, points.data(), static_cast<int>(count), RayTarget::kPeople);
    for (std::size_t i = 0; i < count; ++i) {
      if ((hidden >> i & 1U) != 0U) continue;
      const LightSource& source = lights_.sources()[source_of[i]];
      shares[source_of[i]] += 1.0F / static_cast<float>(source.pointsForBodies());
    }
    count = 0;
  };
  for (std::size_t s = 0; sources != 0; ++s, sources >>= 1U) {
    if ((sources & 1U) == 0U) continue;
    shares[s] = 0.0F;
    for (std::size_t i = 0; i < lights_.sources()[s].pointsForBodies(); ++i) {
      points[count] = lights_.sources()[s].points()[i];
      source_of[count++] = s;
      if (count == points.size()) look();
    }
  }
  if (count > 0) look();
}

int PeopleShadows::countSeen(const Vector3f& p, const Vector3f* points, int count) const {
  unsigned hidden = world_.blocked(p, points, count, RayTarget::kPeople);
  int seen = count;
  for (; hidden != 0U; hidden &= hidden - 1U) --seen;
  return seen;
}

}  // namespace heel
