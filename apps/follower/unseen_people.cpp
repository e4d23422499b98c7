// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/unseen_people.hpp>

#include <algorithm>
#include <cstddef>

namespace heel {

MovingPerson UnseenPeople::now(const Known& known, double stamp_s) {
  MovingPerson person = known.person;
  if (!stands(person)) person.position += (stamp_s - known.seen_s) * person.velocity;
  return person;
}

void UnseenPeople::step(double stamp_s, std::vector<MovingPerson>& people,
                        FunctionRef<bool(const Eigen::Vector2d&)> has_left) {
  const auto isOver = [&](const Known& known) {
    const MovingPerson person = now(known, stamp_s);
    return stamp_s - known.seen_s > (stands(person) ? kStays_s : params_.walks_on_s) ||
           has_left(person.position) ||
           std::any_of(people.begin(), people.end(), [&](const MovingPerson& other) {
             return (other.position - person.position).norm() < params_.near_m;
           });
  };
  for (const Known& known : known_) {  // Who is seen by another sensor now has not just come.
    for (MovingPerson& person : people) {
      if (!(known.person.rests_s > 0.0 && person.rests_s > 0.0)) continue;
      if ((person.position - known.person.position).norm() > params_.near_m) continue;
      person.rests_s = std::max(person.rests_s, known.person.rests_s + stamp_s - known.seen_s);
    }
  }
  known_.erase(std::remove_if(known_.begin(), known_.end(), isOver), known_.end());
  const std::size_t unseen = known_.size();
  for (const MovingPerson& person : people) known_.push_back({person, stamp_s});
  for (std::size_t i = 0; i < unseen; ++i) people.push_back(now(known_[i], stamp_s));
  resting_.clear();
  for (const Known& known : known_) {
    if (!(known.person.rests_s > 0.0)) continue;
    resting_.push_back(known.person);
    resting_.back().radius_m += params_.beside_m;
  }
}

}  // namespace heel
