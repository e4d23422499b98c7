// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/target_place.hpp"

#include "apps/follower/param_checks.hpp"

#include <algorithm>

namespace heel {

TargetPlace::TargetPlace(const TargetPlaceParams& params) : params_(params) {
  requireNotNegative(
      "TargetPlaceParams",
      {params.legs_within_m, params.max_speed_mps, params.walks_on_s, params.legs_alone_s,
       params.legs_in_view_s, params.legs_mixed_s, params.legs_unlike_s, params.legs_apart_m,
       params.sure, params.look_s, params.turn_to_s, params.weak_look_doubt});
}

void TargetPlace::step(const TargetEstimate& seen, const PeopleAround& around,
                       FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
                       FunctionRef<bool(const Eigen::Vector2d&)> is_unlike, double elapsed_s) {
  now_.reset();
  bool is_seen = false;
  if (seen.status == TargetStatus::kFollowed) {
    now_ = MovingPerson{seen.motion.position_m(), seen.motion.velocity_mps()};
    legs_ = around.nearest(now_->position, params_.legs_within_m);
    if (isSureLook(seen)) {
      doubt_ = 0.0;
    } else if (is_unlike(now_->position)) {
      doubt_ = 1.0;
    } else {
      doubt_ = std::min(doubt_, params_.weak_look_doubt);
    }
    mixed_ = false;
    is_seen = true;
  } else if (const Track* legs = believedLegs(around, is_in_view, is_unlike, elapsed_s)) {
    now_ = MovingPerson{legs->motion.position_m(), legs->motion.velocity_mps()};
    is_seen = legs->status == TrackStatus::kConfirmed;
  } else if (seen.status == TargetStatus::kCoasting) {
    now_ = MovingPerson{seen.motion.position_m(), seen.motion.velocity_mps()};
  }
  unseen_s_ = is_seen ? 0.0 : unseen_s_ + elapsed_s;
  if (is_seen) last_ = *now_;
  noteOthers(around, isSureLook(seen));
  findSuspect(around, is_in_view, elapsed_s);
}

void TargetPlace::noteOthers(const PeopleAround& around, bool is_sure) {
  const Eigen::Vector2d place = now_ ? now_->position : last_.position;
  const auto isApart = [&](const Track& track) {
    return (track.motion.position_m() - place).norm() > params_.legs_apart_m;
  };
  // Close by, the laser may take one for the other.
  const auto isDoubtful = [&](int id) {
    const Track* track = around.find(id);
    return track == nullptr || !isApart(*track);
  };
  others_.erase(std::remove_if(others_.begin(), others_.end(), isDoubtful), others_.end());
  if (is_sure) {
    for (const Track& track : around.tracks()) {
      const bool is_known = std::find(others_.begin(), others_.end(), track.id) != others_.end();
      const bool is_other = track.status == TrackStatus::kConfirmed && isApart(track);
      if (track.id != legs_ && is_other && !is_known) others_.push_back(track.id);
    }
  }
  others_m_.clear();
  for (const int id : others_) others_m_.push_back(around.find(id)->motion.position_m());
}

void TargetPlace::findSuspect(const PeopleAround& around,
                              FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
                              double elapsed_s) {
  suspect_.reset();
  if (now_) return attention_.clear();
  int nearest = 0;
  double nearest_m = params_.legs_within_m + unseen_s_ * params_.max_speed_mps;
  for (const int id : around.walkers()) {
    const MotionState& motion = around.find(id)->motion;
    const double away_m = (motion.position_m() - last_.position).norm();
    const bool is_other = std::find(others_.begin(), others_.end(), id) != others_.end();
    if (away_m > nearest_m || is_other || attention_.isEnough(id)) continue;
    nearest_m = away_m;
    nearest = id;
    suspect_ = MovingPerson{motion.position_m(), motion.velocity_mps()};
  }
  if (!suspect_) return;
  const double enough_s = is_in_view(suspect_->position) ? params_.look_s : params_.turn_to_s;
  attention_.pay(nearest, elapsed_s / enough_s);
}

MovingPerson TargetPlace::expected() const {
  if (suspect_) return *suspect_;
  MovingPerson person = last_;
  person.position += std::min(unseen_s_, params_.walks_on_s) * person.velocity;
  return person;
}

const Track* TargetPlace::believedLegs(const PeopleAround& around,
                                       FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
                                       FunctionRef<bool(const Eigen::Vector2d&)> is_unlike,
                                       double elapsed_s) {
  const Track* legs = around.find(legs_);
  if (legs == nullptr) return nullptr;
  const Eigen::Vector2d place = legs->motion.position_m();
  double patience_s = params_.legs_alone_s;
  if (is_in_view(place)) patience_s = params_.legs_in_view_s;
  mixed_ = mixed_ || around.hasOtherNear(legs_, params_.legs_apart_m);
  if (mixed_) patience_s = params_.legs_mixed_s;
  if (is_unlike(place)) patience_s = params_.legs_unlike_s;
  doubt_ += elapsed_s / patience_s;
  return doubt_ < 1.0 ? legs : nullptr;
}

}  // namespace heel
