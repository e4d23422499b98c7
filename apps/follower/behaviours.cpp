// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/behaviours.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kFullTurn_rad = 6.283185307179586;
constexpr double kHalfBody_m = 0.25;
constexpr double kAhead_m = 2.0;        // Any place ahead of a view.
constexpr std::size_t kMostLooks = 32;  // Looks that are remembered.

std::optional<Vector2d> placeOf(const std::optional<MovingPerson>& person) {
  return person ? std::optional(person->position) : std::nullopt;
}

template <typename Event>
void remember(const Event& event, std::vector<Event>& events) {
  if (events.size() == kMostLooks) events.erase(events.begin());
  events.push_back(event);
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

bool Premises::sees(const Vector2d& from, const Vector2d& to) const {
  return !walls ||
         walls->lineOfSight({from.x(), from.y(), eye_m}, {to.x(), to.y(), eye_m}, kHalfBody_m);
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
  std::optional<Intent> aside = aside_.step(now, ways);
  aside->keep_in_view.reset();  // They wait: to make room goes before.
  return aside;
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
  facts[FollowingCondition::kFullTurn] = turned_rad_ > kFullTurn_rad;
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

LookWhoThatIs::LookWhoThatIs(const Premises& premises, const FollowerParams& params)
    : looking_(params.perception.target.identity),
      drive_(params.drive.limits),
      look_s_(params.search.map.look_s),
      ahead_rad_(params.ahead_rad),
      near_m_(params.goal.least_standoff_m),
      far_m_(params.far_m),
      nearer_(premises, params.goal) {}

void LookWhoThatIs::watch(const Situation& now) {
  if (now.target) {
    looks_.clear();
    tries_.clear();
    choice_.reset();
    nearer_.begin(now);
    return;
  }
  clock_s_ += now.elapsed_s;
  std::optional<Choice> best;
  for (const Suspect& suspect : now.suspects) {
    const Choice choice = rated(suspect, now);
    if (choice.per_s > (best ? best->per_s : now.elsewhere_per_s)) best = choice;
  }
  const bool goes_on = best && isOfChoice(best->place);
  choice_ = best;
  looked_s_ = goes_on && best->is_ahead ? looked_s_ + now.elapsed_s : 0.0;
  if (looked_s_ < look_s_) return;
  remember(Look{best->place, best->place - now.robot.position, clock_s_}, looks_);
  looked_s_ = 0.0;
}

bool LookWhoThatIs::isOfChoice(const Vector2d& place) const {
  return choice_ && (place - choice_->place).norm() < kHalfBody_m;
}

double LookWhoThatIs::tried_s(const Vector2d& place) const {
  double sum_s = 0.0;
  for (const Try& one : tries_) {
    if ((one.place - place).norm() < kHalfBody_m) sum_s += one.for_s;
  }
  return sum_s;
}

double LookWhoThatIs::newsOf(const Vector2d& place, const Vector2d& ray_m) const {
  double news = 1.0;
  for (const Look& look : looks_) {
    const double way_m = std::max((place - look.place).norm(), (ray_m - look.ray_m).norm());
    news = std::min(news, looking_.newsOf(clock_s_ - look.stamp_s, way_m));
  }
  return news;
}

// From here, or from where all of them is in view: who stands close before the camera is a piece of
// cloth to it. What has taken so long is likely to take as long again.
LookWhoThatIs::Choice LookWhoThatIs::rated(const Suspect& suspect, const Situation& now) const {
  const Vector2d ray_m = suspect.place - now.robot.position;
  const double off_m = ray_m.norm();
  const double best_m = std::clamp(off_m, near_m_, far_m_);
  const double turn_rad = std::abs(bearingOf(now.robot, suspect.place));
  const bool goes_on = isOfChoice(suspect.place);
  const double look_s = turn_rad / drive_.max_turn_radps + look_s_ - (goes_on ? looked_s_ : 0.0);
  const double way_s = std::abs(off_m - best_m) / drive_.max_speed_mps + tried_s(suspect.place);
  const Vector2d best_ray_m = best_m / std::max(off_m, 1e-9) * ray_m;
  const double here = newsOf(suspect.place, ray_m) / look_s;
  const double there = newsOf(suspect.place, best_ray_m) / (look_s + way_s);
  const bool is_ahead = turn_rad < ahead_rad_;
  const bool goes = there > here;
  return {suspect.place, is_ahead, goes, suspect.probability * std::max(here, there)};
}

std::optional<Intent> LookWhoThatIs::step(const Situation& now, const Ways& ways) {
  if (!choice_) return std::nullopt;
  Intent intent;
  intent.reason = "looks who that is";
  const Vector2d& place = choice_->place;
  intent.look_at = place;
  if (choice_->goes) {
    if (tries_.empty() || (tries_.back().place - place).norm() > kHalfBody_m) {
      remember(Try{place, 0.0}, tries_);
    }
    tries_.back().for_s += now.elapsed_s;
    MovingPerson person;
    person.position = place;
    intent.go_to = nearer_.placeBy(person, now, ways);
    intent.keep_in_view = place;
  }
  return intent;
}

}  // namespace heel
