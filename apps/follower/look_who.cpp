// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/look_who.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kHalfBody_m = 0.25;
constexpr std::size_t kMostLooks = 32;

}  // namespace

LookWhoThatIs::LookWhoThatIs(const Premises& premises, const FollowerParams& params)
    : looking_(params.perception.target.identity),
      drive_(params.drive.limits),
      look_s_(params.search.map.look_s),
      ahead_rad_(params.ahead_rad),
      near_m_(params.goal.least_standoff_m),
      far_m_(std::max(params.far_m, near_m_)),
      nearer_(premises, params.goal) {}

void LookWhoThatIs::watch(const Situation& now) {
  if (now.target) {
    looks_.clear();
    choice_.reset();
    nearer_.begin(now);
    return;
  }
  clock_s_ += now.elapsed_s;
  const bool has_turned = std::exchange(has_turned_, false);
  std::optional<Choice> best;
  for (const Suspect& suspect : now.suspects) {
    const Choice choice = rated(suspect, now);
    if (choice.per_s > (best ? best->per_s : now.elsewhere_per_s)) best = choice;
  }
  const bool goes_on = best && isOfChoice(best->place);
  choice_ = best;
  looked_s_ = goes_on && (best->is_ahead || has_turned) ? looked_s_ + now.elapsed_s : 0.0;
  is_near_ = is_near_ && goes_on;
  if (!best || looked_s_ < look_s_) return;
  remember(best->place, best->place - now.robot.position);
  if (is_near_) remember(best->place, best->ray_m);
  is_near_ = false;
  looked_s_ = 0.0;
}

void LookWhoThatIs::note(const IntentOutcome& outcome) {
  is_near_ = is_near_ || outcome.has_arrived;
  has_turned_ = outcome.has_looked;
}

void LookWhoThatIs::remember(const Vector2d& place, const Vector2d& ray_m) {
  if (looks_.size() == kMostLooks) looks_.erase(looks_.begin());
  looks_.push_back({place, ray_m, clock_s_});
}

bool LookWhoThatIs::isOfChoice(const Vector2d& place) const {
  return choice_ && (place - choice_->place).norm() < kHalfBody_m;
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
// cloth to it.
LookWhoThatIs::Choice LookWhoThatIs::rated(const Suspect& suspect, const Situation& now) const {
  const Vector2d ray_m = suspect.place - now.robot.position;
  const double off_m = ray_m.norm();
  const double best_m = std::clamp(off_m, near_m_, far_m_);
  const Vector2d best_ray_m = best_m / std::max(off_m, 1e-9) * ray_m;
  const double turn_rad = std::abs(bearingOf(now.robot, suspect.place));
  const double look_s = turn_rad / drive_.max_turn_radps + look_s_;
  const double way_s = std::abs(off_m - best_m) / drive_.max_speed_mps;
  const double here = newsOf(suspect.place, ray_m), there = newsOf(suspect.place, best_ray_m);
  const bool goes = there / (look_s + way_s) > here / look_s;
  const double takes_s = look_s + (goes ? way_s : 0.0);
  const double left_s = takes_s - (isOfChoice(suspect.place) ? looked_s_ : 0.0);
  return {suspect.place, goes ? best_ray_m : ray_m, turn_rad < ahead_rad_, goes,
          suspect.probability * (goes ? there : here) / left_s};
}

std::optional<Intent> LookWhoThatIs::step(const Situation& now, const Ways& ways) {
  if (!choice_) return std::nullopt;
  Intent intent;
  intent.reason = "looks who that is";
  const Vector2d& place = choice_->place;
  intent.look_at = place;
  if (choice_->goes) {
    MovingPerson person;
    person.position = place;
    intent.go_to = nearer_.placeBy(person, now, ways);
    intent.keep_in_view = place;
    is_near_ = is_near_ || !intent.go_to;
  }
  return intent;
}

}  // namespace heel
