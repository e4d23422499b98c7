// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/standing_people.hpp>

#include <algorithm>

namespace heel {

void StandingPeople::note(double stamp_s, const std::vector<MovingPerson>& people,
                          FunctionRef<bool(const Eigen::Vector2d&)> has_left) {
  const auto isOver = [&](const FloorDisc& stood) {
    return has_left(stood.center) ||
           std::any_of(people.begin(), people.end(), [&](const MovingPerson& person) {
             return (person.position - stood.center).norm() < params_.near_m;
           });
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    if (stamp_s - seen_s_[i] > kStays_s || isOver(discs_[i])) continue;
    discs_[kept] = discs_[i];
    seen_s_[kept++] = seen_s_[i];
  }
  remembered_ = kept;
  discs_.resize(kept);
  for (const MovingPerson& person : people) {
    if (person.velocity.norm() > params_.slower_than_mps) continue;
    discs_.push_back({person.position, person.radius_m + params_.beside_m});
  }
  seen_s_.resize(kept);
  seen_s_.resize(discs_.size(), stamp_s);
}

}  // namespace heel
