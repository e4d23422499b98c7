// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/behaviours.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kHalfBody_m = 0.25;
constexpr double kSeenSide_m = 0.75 * kHalfBody_m;  // Off their middle, of both sides.
constexpr double kAhead_m = 2.0;                    // Any place ahead of a view.

std::optional<Vector2d> placeOf(const std::optional<MovingPerson>& person) {
  return person ? std::optional(person->position) : std::nullopt;
}

}  // namespace

MovingPerson Situation::expected(double walks_on_s) const {
  MovingPerson person = last;
  person.position += std::min(unseen_s, walks_on_s) * person.velocity;
  return person;
}

Premises::Premises(const FollowerParams& params, std::shared_ptr<const WallMap> the_walls,
                   std::vector<DoorwayOnMap> the_doorways)
    : walls(std::move(the_walls)),
      doorways(std::move(the_doorways)),
      passage_depth_m(params.goal.doorway_depth_m),
      radius_m(params.goal.radius_m),
      eye_m(params.gate.eye_height_m) {}

// Who is hidden by half is seen, and lost at the next step; nor do they see the robot.
bool Premises::sees(const Vector2d& from, const Vector2d& person) const {
  if (!walls) return true;
  const Vector2d ray = (person - from).normalized();
  const Vector2d side = kSeenSide_m * Vector2d(-ray.y(), ray.x());
  const auto isOpen = [&](const Vector2d& to) {
    return walls->lineOfSight({from.x(), from.y(), eye_m}, {to.x(), to.y(), eye_m}, kHalfBody_m);
  };
  return isOpen(person + side) && isOpen(person - side);
}

std::optional<Intent> FollowTarget::step(const Situation& now, const Ways& ways) {
  Intent intent;
  intent.keep_in_view = placeOf(now.target);
  if (!now.target) {
    intent.go_to = now.last.position;
    return intent;
  }
  intent.go_to = placeBy(*now.target, now, ways).value_or(now.target->position);
  return intent;
}

std::optional<Vector2d> FollowTarget::placeBy(const MovingPerson& person, const Situation& now,
                                              const Ways& ways) {
  const auto sees = [this](const Vector2d& from, const Vector2d& to) {
    return premises_.sees(from, to);
  };
  return places_.choose(person, now.robot.position, ways.free, sees, premises_.doorways);
}

std::optional<Intent> FaceTarget::step(const Situation& now, const Ways& ways) {
  Intent intent;
  intent.look_at = placeOf(now.target);
  const Vector2d& here = now.robot.position;
  if (!premises_.isInDoorway(here)) return intent;
  // Close by they leave no room to drive, and will be in view when they have gone past.
  if (now.target && (now.target->position - here).norm() < beside_m_) return intent;
  // They wait: to make room goes before, then it looks at them.
  intent.go_to = aside_.step(now, ways)->go_to;
  return intent;
}

std::optional<Intent> GoToLastSeen::step(const Situation& now, const Ways&) {
  Intent intent;
  intent.go_to = now.last.position;
  intent.near_enough_m = near_m_;
  intent.keep_in_view = placeOf(now.target);
  return intent;
}

void SeekTarget::begin(const Situation& now) {
  turned_rad_ = 0.0;
  side_ = bearingOf(now.robot, now.expected(walks_on_s_).position) < 0.0 ? -1.0 : 1.0;
}

std::optional<Intent> SeekTarget::step(const Situation& now, const Ways&) {
  turned_rad_ += std::abs(now.turned_rad);
  Intent intent;
  intent.look_at = now.robot * Vector2d(0.0, side_);
  intent.most_turn_radps = most_turn_radps_;
  return intent;
}

void SeekTarget::tell(FollowingFacts& facts) const {
  facts[FollowingCondition::kFullTurn] = turned_rad_ > 2.0 * M_PI;
}

void SearchForTarget::begin(const Situation&) {
  if (search_ != nullptr) search_->restart();
  is_there_ = false;
}

std::optional<Intent> SearchForTarget::step(const Situation& now, const Ways& ways) {
  Intent intent;
  if (search_ == nullptr) {
    intent.reason = "waits: there is no map";
    return intent;
  }
  const auto way_s = [&](const Vector2d& place) { return ways.takes_s(now.robot, place); };
  intent.is_new = search_->choose(now.elapsed_s, now.robot, std::exchange(is_there_, false), way_s);
  if (const std::optional<SearchView>& view = search_->view()) {
    intent.go_to = view->camera.position;
    intent.look_at = view->camera * Vector2d(kAhead_m, 0.0);
    intent.keep_in_view = placeOf(now.target);
  }
  return intent;
}

void SearchForTarget::note(const IntentOutcome& outcome) {
  is_there_ = outcome.has_arrived && outcome.has_looked;
}

void SearchForTarget::tell(FollowingFacts& facts) const {
  facts[FollowingCondition::kSearchOver] = search_ != nullptr && search_->isOver();
}

}  // namespace heel
