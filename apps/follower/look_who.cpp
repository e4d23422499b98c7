// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/look_who.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kBody_m = 0.5;      // Two so near each other are in one place.
constexpr double kHalfOfView = 2.0;  // From so much further they fill half of what they filled.

GoalChooserParams wholeInView(const FollowerParams& params) {
  GoalChooserParams goal = params.goal;
  goal.standoff_m = params.whole_m;
  goal.nearest_share = 1.0;
  goal.furthest_share = kHalfOfView;
  return goal;
}

}  // namespace

LookWhoThatIs::LookWhoThatIs(const Premises& premises, const FollowerParams& params)
    : drive_(params.drive.limits),
      look_s_(params.search.map.look_s),
      near_m_(params.whole_m),
      far_m_(kHalfOfView * params.whole_m),
      whole_(premises, wholeInView(params)) {}

void LookWhoThatIs::watch(const Situation& now) {
  choice_.reset();
  if (now.target) {
    efforts_.clear();
    whole_.begin(now);
    return;
  }
  for (const Suspect& suspect : now.suspects) {
    const Choice choice = rated(suspect, now);
    if (choice.per_s > (choice_ ? choice_->per_s : now.elsewhere_per_s)) choice_ = choice;
  }
}

std::size_t LookWhoThatIs::find(const Vector2d& place, bool is_whole) const {
  const auto found = std::find_if(efforts_.begin(), efforts_.end(), [&](const Effort& effort) {
    return effort.is_whole == is_whole && (effort.place - place).norm() < kBody_m;
  });
  return static_cast<std::size_t>(found - efforts_.begin());
}

// From here, or from where all of them is in view: who stands close before the camera is a piece of
// cloth to it. What took n looks takes n again once in two times: more than n are needed with a
// chance of 1 / (1 + n), and the next one is it with 1 / (1 + n)^2.
LookWhoThatIs::Choice LookWhoThatIs::rated(const Suspect& suspect, const Situation& now) const {
  const double off_m = (suspect.place - now.robot.position).norm();
  const double way_s = std::abs(off_m - std::clamp(off_m, near_m_, far_m_)) / drive_.max_speed_mps;
  const double turn_s = std::abs(bearingOf(now.robot, suspect.place)) / drive_.max_turn_radps;
  const auto from = [&](bool is_whole, double on_way_s) {
    const std::size_t effort = find(suspect.place, is_whole);
    const double more = 1.0 + (effort < efforts_.size() ? efforts_[effort].looks : 0.0);
    const double takes_s = on_way_s + turn_s + look_s_;
    const double per_s = suspect.probability / (more * more * takes_s);
    return Choice{suspect.place, is_whole, on_way_s > 0.0, takes_s, per_s};
  };
  const Choice whole = from(true, way_s);
  if (!whole.goes) return whole;
  const Choice here = from(false, 0.0);
  return whole.per_s > here.per_s ? whole : here;
}

std::optional<Intent> LookWhoThatIs::step(const Situation& now, const Ways& ways) {
  if (!choice_) return std::nullopt;
  const Vector2d& place = choice_->place;
  const std::size_t effort = find(place, choice_->is_whole);
  if (effort == efforts_.size()) efforts_.push_back({place, choice_->is_whole});
  efforts_[effort].looks += now.elapsed_s / choice_->takes_s;
  Intent intent;
  intent.reason = "looks who that is";
  intent.look_at = place;
  if (choice_->goes) {
    MovingPerson person;
    person.position = place;
    intent.go_to = whole_.placeBy(person, now, ways);
    intent.keep_in_view = place;
  }
  return intent;
}

}  // namespace heel
