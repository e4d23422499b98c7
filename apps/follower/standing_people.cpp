// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/standing_people.hpp>

#include <algorithm>

namespace heel {

void noteStanding(const StandingPeopleParams& params, const std::vector<MovingPerson>& people,
                  const std::vector<Track>& tracks,
                  const std::function<bool(const Eigen::Vector2d&)>& has_left,
                  std::vector<FloorDisc>& standing) {
  const auto isOver = [&](const FloorDisc& stood) {
    const auto isNear = [&](const Eigen::Vector2d& place) {
      return (place - stood.center).norm() < params.near_m;
    };
    return has_left(stood.center) ||
           std::any_of(people.begin(), people.end(),
                       [&](const MovingPerson& person) { return isNear(person.position); }) ||
           std::any_of(tracks.begin(), tracks.end(), [&](const Track& track) {
             return track.observation != Track::kUnseen && isNear(track.motion.position_m());
           });
  };
  standing.erase(std::remove_if(standing.begin(), standing.end(), isOver), standing.end());
  for (const MovingPerson& person : people) {
    if (person.velocity.norm() > params.slower_than_mps) continue;
    standing.push_back({person.position, person.radius_m + params.beside_m});
  }
}

}  // namespace heel
