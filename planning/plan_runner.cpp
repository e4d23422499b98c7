// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/plan_runner.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace heel {

PlanRunner::PlanRunner(PetriPlan plan)
    : plan_(std::move(plan)), facts_(plan_.vocabulary.conditions.size()) {
  if (plan_.places.size() != plan_.net.places.size() ||
      plan_.transitions.size() != plan_.net.transitions.size()) {
    throw std::invalid_argument("a plan needs a role for each place and transition");
  }
  const std::size_t actions = plan_.vocabulary.actions.size();
  std::size_t calls = actions;
  for (const TransitionRole& role : plan_.transitions) calls += role.calls.size();
  step_.active.reserve(actions);
  step_.started.reserve(calls);
  step_.ended.reserve(calls + actions);
  reset();
}

void PlanRunner::reset() {
  marking_ = initialMarking(plan_.net);
  left_ = marking_;
  step_.started.clear();
  step_.ended.clear();
  step_.outcome = outcomeAt(plan_, marking_);
  findActive();
}

bool PlanRunner::isActive(int action) const {
  return std::find(step_.active.begin(), step_.active.end(), action) != step_.active.end();
}

const PlanStep& PlanRunner::advance() {
  step_.started.clear();
  step_.ended.clear();
  if (step_.outcome != PlanOutcome::kRunning) return step_;
  left_ = marking_;
  for (std::size_t t = 0; t < plan_.transitions.size() && step_.outcome == PlanOutcome::kRunning;
       ++t) {
    if (!isEnabled(plan_.net.transitions[t], left_) || !plan_.transitions[t].guard.holds(facts_)) {
      continue;
    }
    fireTransition(t);
    step_.outcome = outcomeAt(plan_, marking_);
  }
  findActive();
  if (step_.outcome != PlanOutcome::kRunning) {
    // The end of the plan is the end of all that still runs beside it.
    step_.ended.insert(step_.ended.end(), step_.active.begin(), step_.active.end());
    step_.active.clear();
  }
  return step_;
}

void PlanRunner::fireTransition(std::size_t transition) {
  const PetriTransition& fires = plan_.net.transitions[transition];
  fire(fires, marking_);
  for (const PetriArc& arc : fires.takes) left_[static_cast<std::size_t>(arc.place)] -= arc.weight;
  for (const ActionCall& call : plan_.transitions[transition].calls) {
    switch (call.event) {
      case ActionEvent::kStart:
      case ActionEvent::kResume:
        step_.started.push_back(call.action);
        break;
      case ActionEvent::kEnd:
      case ActionEvent::kFail:
        step_.ended.push_back(call.action);
        break;
      case ActionEvent::kInterrupt:
        break;
    }
  }
}

void PlanRunner::findActive() {
  step_.active.clear();
  for (std::size_t p = 0; p < plan_.places.size(); ++p) {
    const int action = plan_.places[p].action;
    if (action >= 0 && marking_[p] > 0 && !isActive(action)) step_.active.push_back(action);
  }
}

}  // namespace heel
