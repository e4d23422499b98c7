// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// From what the plan says to a velocity.

#include <heel/apps/follower/follower.hpp>

#include <array>
#include <optional>
#include <string>

namespace heel {
namespace {

using Eigen::Vector2d;

// What is known by then goes before, in one line.
void append(std::string& reasons, const std::string& reason) {
  if (!reasons.empty() && !reason.empty()) reasons += "; ";
  reasons += reason;
}

}  // namespace

// A speed for what the plan says (section 3.3); nothing moves while it is not safe.
void Follower::drive() {
  now_.way_to.reset();
  if (step_.path != nullptr && !step_.path->empty()) now_.way_to = step_.path->back();
  make_room_.watch(now_);
  step_.goal.reset();
  step_.path = nullptr;
  step_.velocity = {};
  if (step_.is_paused) {
    step_.reason = "told to wait";
  } else if (step_.is_learning) {
    step_.reason = "learns whom to follow";
  } else if (!watch_.blindness().empty()) {
    step_.reason = watch_.blindness();
  } else if (step_.robot.lost) {  // Another view may tell; the last gate lets it turn where it can.
    step_.reason = "does not know where it is";
    step_.velocity.turn_radps = params_.lost_turn_radps;
  } else {
    step_.reason = now_.target || step_.perception == nullptr ? "" : step_.perception->reason;
    behave();
  }
}

// The first behaviour that wants something has it.
void Follower::behave() {
  const auto room = [this](const Vector2d& place) { return pilot_.room_m(place); };
  const auto free = [this](const Vector2d& place) { return pilot_.free_m(place); };
  const auto plan = [this](const Vector2d& from, const Vector2d& to) -> const GlobalPlan& {
    return pilot_.plan(from, to);
  };
  const auto takes_s = [this](const FloorPose& from, const Vector2d& to) {
    return pilot_.takes_s(from, to);
  };
  const Ways ways{room, free, plan, takes_s};
  const bool acts = action_ != FollowingAction::kStop;
  const bool looks_for_them =
      action_ == FollowingAction::kSeek || action_ == FollowingAction::kSearch;
  std::array<Behaviour*, 3> behaviours{nullptr, nullptr, behaviourOf(action_)};
  if (acts) behaviours[0] = &make_room_;
  if (looks_for_them) behaviours[1] = &look_who_;
  for (Behaviour* behaviour : behaviours) {
    if (behaviour == nullptr) continue;
    const std::optional<Intent> intent = behaviour->step(now_, ways);
    if (!intent) continue;
    behaviour->note(carryOut(*intent));
    // Beside the way is not where the plan wants to be.
    if (behaviour == &make_room_) has_arrived_ = false;
    return;
  }
}

IntentOutcome Follower::carryOut(const Intent& intent) {
  append(step_.reason, intent.reason);
  // The map's walls may be off, and what is near them is left out of the layer: not so what the
  // last gate sees, which leaves as little room as this.
  const FloorPose to_motion = motion_.pose() * step_.robot.pose.inverse();
  const double spare_m = params_.drive.margin_m - params_.last_gate.margin_m;
  const auto sensed = [&](const Vector2d& p) {
    return last_gate_.clearance(to_motion * p) + spare_m;
  };
  last_gate_.locate({motion_.pose(), speed_}, steady_s_ - motion_.stamp_s(), steady_s_);
  const auto permits = [&](const VelocityCommand& velocity) { return last_gate_.lets(velocity); };
  hidden_.clear();
  const FloorPose from_motion = to_motion.inverse();
  for (const Vector2d& place : hiding_places_) hidden_.push_back(from_motion * place);
  pilot_.expect(hidden_);
  const PilotStep now =
      pilot_.step(intent, {step_.robot.pose, speed_}, now_.people, sensed, permits, now_.elapsed_s);
  append(step_.reason, now.reason);
  step_.velocity = now.velocity;
  step_.path = now.path;
  step_.goal = now.goal;
  has_arrived_ = now.outcome.has_arrived;
  return now.outcome;
}

// Nothing gets to the wheels but through it.
void Follower::passLastGate() {
  const GatedVelocity gated = last_gate_.pass(step_.velocity, {motion_.pose(), speed_},
                                              steady_s_ - motion_.stamp_s(), steady_s_);
  step_.velocity = gated.velocity;
  if (gated.reason != GateReason::kFree) append(step_.reason, describe(gated.reason));
}

}  // namespace heel
