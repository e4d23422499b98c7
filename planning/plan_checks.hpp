// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What is proved of a plan before a robot runs it.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <string>
#include <vector>

namespace heel {

/// What can be wrong with a plan whose names are all known.
enum class PlanFlaw {
  kActionsOutOfStep,  ///< A transition moves an action's token without telling it, or the reverse.
  kUnboundedPlace,    ///< Tokens can pile up without end.
  kDeadTransition,    ///< It can never fire.
  kNoGoal,            ///< There is none, or it can't be reached.
  kDeadlock,          ///< The plan can get where neither goal nor fail can be reached any more.
  kTooLarge,          ///< It has more states than are looked at.
};

/// What is wrong with a plan.
struct PlanFault {
  PlanFlaw flaw = PlanFlaw::kNoGoal;
  std::string sentence;  ///< Names the element and the reason.
};

/// What was found, and on how much it rests.
struct PlanReport {
  std::vector<PlanFault> faults;  ///< Empty for a sound plan.
  std::size_t states = 0;         ///< Markings that the plan can get to.
};

/// Looks at every marking that the plan can get to when any guard may hold at any time, but one
/// that holds never. Nothing happens after the goal or a failure. Unbounded places are found with
/// Karp and Miller's coverability tree; then only actions, bounds and transitions are judged.
PlanReport checkPlan(const PetriPlan& plan);

}  // namespace heel
