// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/following_plan.hpp>

namespace heel {

namespace {

constexpr std::array<const char*, kFollowingActions> kActionNames = {
    "stop", "follow", "face", "goToLastSeen", "seek", "search"};

constexpr std::array<const char*, kFollowingConditions> kConditionNames = {
    "targetSeen",   "targetLost", "near",       "far",   "arrived",
    "lookedAround", "fullTurn",   "searchOver", "blind", "done"};

}  // namespace

const char* nameOf(FollowingAction action) {
  return kActionNames[static_cast<std::size_t>(action)];
}

const PlanVocabulary& followingVocabulary() {
  static const PlanVocabulary vocabulary{{kActionNames.begin(), kActionNames.end()},
                                         {kConditionNames.begin(), kConditionNames.end()}};
  return vocabulary;
}

FollowingAction currentAction(const PlanRunner& runner) {
  const auto& active = runner.last().active;
  if (active.empty() || runner.isActive(static_cast<int>(FollowingAction::kStop))) {
    return FollowingAction::kStop;
  }
  return static_cast<FollowingAction>(active.front());
}

}  // namespace heel
