// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Runs a Petri Net Plan.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <vector>

namespace heel {

/// What one step changed. Actions are indices into the plan's vocabulary.
struct PlanStep {
  PlanOutcome outcome = PlanOutcome::kRunning;
  std::vector<int> active;   ///< Actions that run after the step.
  std::vector<int> started;  ///< Started or resumed.
  std::vector<int> ended;    ///< Came to their end, or failed.
};

/// A plan and where it stands.
///
/// In a step each transition can fire once. All guards see the same facts and no token moves twice,
/// so that what starts in a step is not ended by a fact about what ran before. Of transitions that
/// want the same token, the first in the file gets it. No step allocates.
class PlanRunner {
 public:
  /// @throws std::invalid_argument  unless the plan has a role for each place and transition.
  explicit PlanRunner(PetriPlan plan);

  const PetriPlan& plan() const { return plan_; }
  const Marking& marking() const { return marking_; }
  /// What the last step did; before the first, the actions that run at the start.
  const PlanStep& last() const { return step_; }
  bool isActive(int action) const;

  /// Goes on by one step. After an end nothing happens any more, and no action runs.
  /// @param holds  Whether a condition, by its index in the vocabulary, holds: `bool(int)`; asked
  ///               once for each.
  template <typename Holds>
  const PlanStep& step(Holds&& holds) {
    for (std::size_t c = 0; c < facts_.size(); ++c) {
      facts_[c] = holds(static_cast<int>(c)) ? 1 : 0;
    }
    return advance();
  }

  /// Back to the start.
  void reset();

 private:
  const PlanStep& advance();
  void fireTransition(std::size_t transition);
  void findActive();

  PetriPlan plan_;
  Marking marking_;
  Marking left_;  ///< Tokens of before the step that nothing has taken yet.
  std::vector<char> facts_;
  PlanStep step_;
};

}  // namespace heel
