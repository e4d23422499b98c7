// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/look_who.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kHalfBody_m = 0.25;
constexpr std::size_t kMostEvents = 32;

bool isSame(const Vector2d& a, const Vector2d& b) { return (a - b).norm() < kHalfBody_m; }

template <typename Event>
void remember(const Event& event, std::vector<Event>& events) {
  if (events.size() == kMostEvents) events.erase(events.begin());
  events.push_back(event);
}

}  // namespace

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
    spent_.clear();
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
  const bool goes_on = best && choice_ && isSame(best->place, choice_->place);
  choice_ = best;
  looked_s_ = goes_on && best->is_ahead ? looked_s_ + now.elapsed_s : 0.0;
  if (looked_s_ < look_s_) return;
  remember(Look{best->place, best->place - now.robot.position, clock_s_}, looks_);
  looked_s_ = 0.0;
}

double LookWhoThatIs::newsOf(const Vector2d& place, const Vector2d& ray_m) const {
  double news = 1.0;
  for (const Look& look : looks_) {
    const double way_m = std::max((place - look.place).norm(), (ray_m - look.ray_m).norm());
    news = std::min(news, looking_.newsOf(clock_s_ - look.stamp_s, way_m));
  }
  return news;
}

double LookWhoThatIs::spent_s(const Vector2d& place) const {
  double sum_s = 0.0;
  for (const Spent& spent : spent_) sum_s += isSame(spent.place, place) ? spent.for_s : 0.0;
  return sum_s;
}

void LookWhoThatIs::spend(const Vector2d& place, double for_s) {
  for (Spent& spent : spent_) {
    if (!isSame(spent.place, place)) continue;
    spent.for_s += for_s;
    return;
  }
  remember(Spent{place, for_s}, spent_);
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
  const double takes_s = look_s + (goes ? way_s : 0.0) + spent_s(suspect.place);
  return {suspect.place, turn_rad < ahead_rad_, goes,
          suspect.probability * (goes ? there : here) / takes_s};
}

std::optional<Intent> LookWhoThatIs::step(const Situation& now, const Ways& ways) {
  if (!choice_) return std::nullopt;
  Intent intent;
  intent.reason = "looks who that is";
  const Vector2d& place = choice_->place;
  intent.look_at = place;
  spend(place, now.elapsed_s);
  if (choice_->goes) {
    MovingPerson person;
    person.position = place;
    intent.go_to = nearer_.placeBy(person, now, ways);
    intent.keep_in_view = place;
  }
  return intent;
}

}  // namespace heel
