// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/make_room.hpp>

#include <algorithm>
#include <cstddef>

namespace heel {

using Eigen::Vector2d;

void MakeRoom::watch(const Situation& now) {
  elapsed_s_ = now.elapsed_s;
  const Vector2d& here = now.robot.position;
  if ((here - stood_at_).norm() > params_.drive.limits.radius_m) {
    stood_at_ = here;
    stuck_s_ = 0.0;
  } else if (now.way_to && (*now.way_to - here).norm() > params_.drive.depart_m) {
    stuck_s_ += now.elapsed_s;
  }
}

std::optional<Intent> MakeRoom::step(const Situation& now, const Ways& ways) {
  bool is_new = false;
  if (!aside_) {
    const MovingPerson* person = whoWantsPast(now, ways);
    is_new = person != nullptr && goAside(*person, now, ways);
  }
  if (!aside_) return std::nullopt;
  aside_->since_s += now.elapsed_s;
  const auto isThere = [&](const MovingPerson& person) {
    return (person.position - aside_->before).norm() < params_.far_m;
  };
  const bool waits = aside_->is_for_target
                         ? !now.target || isThere(*now.target)
                         : std::any_of(now.people.begin(), now.people.end(), isThere);
  if (!waits || aside_->since_s > params_.makes_room_s ||
      aside_->waited_s > params_.waits_aside_s) {
    aside_.reset();
    return std::nullopt;
  }
  Intent intent;
  intent.go_to = aside_->place;
  intent.is_new = is_new;
  intent.look_at = (now.target ? *now.target : now.last).position;
  return intent;
}

void MakeRoom::note(const IntentOutcome& outcome) {
  if (aside_ && outcome.has_arrived) aside_->waited_s += elapsed_s_;
}

const MovingPerson* MakeRoom::whoWantsPast(const Situation& now, const Ways& ways) {
  if (now.target && isInTheWayOf(*now.target, now, ways)) return &*now.target;
  if (stuck_s_ <= params_.give_up_s) return nullptr;
  stuck_s_ = 0.0;
  const auto end = now.people.begin() + static_cast<std::ptrdiff_t>(now.seen_people);
  const auto waits = std::find_if(now.people.begin(), end,
                                  [&](const auto& p) { return isInTheWayOf(p, now, ways); });
  return waits == end ? nullptr : &*waits;
}

bool MakeRoom::isInTheWayOf(const MovingPerson& person, const Situation& now,
                            const Ways& ways) const {
  const Vector2d& here = now.robot.position;
  const Vector2d to_robot = here - person.position;
  const bool comes = person.velocity.dot(to_robot) > kSlowestWalk_mps * to_robot.norm();
  if (to_robot.norm() > (comes ? params_.far_m : params_.beside_m)) return false;
  return premises_.isInDoorway(here) ||
         !leavesRoom(here, person.position, ways.room, params_.wayside);
}

bool MakeRoom::goAside(const MovingPerson& person, const Situation& now, const Ways& ways) {
  const Vector2d& here = now.robot.position;
  near_.assign(1, person.position);
  for (std::size_t i = 0; i < now.seen_people; ++i) {
    const Vector2d& place = now.people[i].position;
    if ((place - here).norm() < params_.far_m) near_.push_back(place);
  }
  findWaysides(here, near_, ways.room, premises_.doorways, params_.wayside, places_);
  for (const Vector2d& place : places_) {
    const GlobalPlan& plan = ways.plan(here, place);
    const bool is_near = plan.length_m < 1.5 * params_.wayside.reach_m;
    if (!plan.found() || !is_near || (plan.end - place).norm() > params_.wayside.apart_m) continue;
    aside_ = Aside{place, here, now.target && &person == &*now.target};
    return true;
  }
  return false;
}

}  // namespace heel
