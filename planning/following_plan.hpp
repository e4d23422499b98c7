// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a plan for following a person can do, and what it can ask.
#pragma once

#include <heel/planning/plan_runner.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace heel {

/// What the robot can do.
enum class FollowingAction {
  kStop,          ///< Stands still.
  kFollow,        ///< Goes to a place at a good distance from the person, and keeps them in view.
  kFace,          ///< Stands and turns towards the person.
  kGoToLastSeen,  ///< Goes to where the person was last seen.
  kSeek,          ///< Turns on the spot, towards the side where the person was last seen.
  kSearch,        ///< Goes and looks where the person can have gone.
};
constexpr std::size_t kFollowingActions = 6;

/// What a plan can ask. None is remembered: each tells how things are now.
enum class FollowingCondition {
  kTargetSeen,    ///< The person is tracked and their place is known from current readings.
  kTargetLost,    ///< They have not been seen for so long that their place is no longer known.
  kNear,          ///< Seen, and within a metre.
  kFar,           ///< Seen, and clearly further than a metre: neither near nor far is in between.
  kArrived,       ///< The robot is where it was going to, or as near as it can get.
  kLookedAround,  ///< The seek has turned so far that it has seen what is near.
  kFullTurn,      ///< The seek has turned once around.
  kSearchOver,    ///< The time for searching is used up, or there is no place left to look at.
  kBlind,         ///< Readings are missing or make no sense: it is not safe to move.
  kDone,          ///< The person was accompanied for as long as was asked. Follower is never asked
                  ///< to end, so it never says so.
};
constexpr std::size_t kFollowingConditions = 10;

/// The word for it in a plan: `goToLastSeen`.
const char* nameOf(FollowingAction action);

/// All of the above, in their order.
const PlanVocabulary& followingVocabulary();

/// Which conditions hold.
class FollowingFacts {
 public:
  bool& operator[](FollowingCondition c) { return holds_[static_cast<std::size_t>(c)]; }
  bool operator[](FollowingCondition c) const { return holds_[static_cast<std::size_t>(c)]; }
  /// As PlanRunner::step() asks.
  bool operator()(int condition) const { return holds_[static_cast<std::size_t>(condition)]; }

 private:
  std::array<bool, kFollowingConditions> holds_{};
};

/// What the robot does in the runner's present state. A plan may run `stop` beside another action,
/// to hold it: then the robot stops. It also stops when nothing runs.
FollowingAction currentAction(const PlanRunner& runner);

}  // namespace heel
