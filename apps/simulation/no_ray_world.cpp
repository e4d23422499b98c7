// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// In place of ray_world.cpp in a build without Embree.

#include <heel/apps/simulation/ray_world.hpp>

#include <stdexcept>

namespace heel {

struct RayWorld::Scenes {
  std::vector<BodyPart> parts;
  std::vector<PersonBounds> around;
};

RayWorld::RayWorld(const Geometry& /*geometry*/) {
  throw std::runtime_error(
      "this build of Heel simulates nothing (Debian's libembree-dev; "
      "cmake -DHEEL_WITH_SIMULATION=ON)");
}
RayWorld::~RayWorld() = default;
RayWorld::RayWorld(RayWorld&&) noexcept = default;
RayWorld& RayWorld::operator=(RayWorld&&) noexcept = default;

void RayWorld::setPeople(std::vector<BodyPart> /*parts*/) {}
const std::vector<BodyPart>& RayWorld::bodyParts() const { return scenes_->parts; }
const std::vector<PersonBounds>& RayWorld::people() const { return scenes_->around; }
RayHit RayWorld::trace(const Eigen::Vector3f&, const Eigen::Vector3f&, float, RayTarget) const {
  return {};
}
void RayWorld::trace(const Eigen::Vector3f&, const Eigen::Vector3f*, int,
                     std::array<RayHit, kPacket>&) const {}
bool RayWorld::blocked(const Eigen::Vector3f&, const Eigen::Vector3f&, RayTarget) const {
  return false;
}
unsigned RayWorld::blocked(const Eigen::Vector3f&, const Eigen::Vector3f*, int, RayTarget) const {
  return 0;
}
bool RayWorld::peopleNear(const Eigen::Vector3f&, const Eigen::Vector3f&, float,
                          std::uint64_t) const {
  return false;
}

}  // namespace heel
