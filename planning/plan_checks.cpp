// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/plan_checks.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace heel {

namespace {

constexpr std::size_t kMostStates = 20000;
constexpr int kWithoutEnd = std::numeric_limits<int>::max() / 2;  // Karp and Miller's omega

/// A marking that can be reached, and how.
struct State {
  Marking marking;
  int parent = -1;
  std::vector<int> next;  ///< Indices of states.
};

/// Whether some facts make the guard hold.
bool canHold(const TransitionRole& role, std::size_t conditions) {
  const auto& used = role.guard.conditions();
  std::vector<char> facts(conditions, 0);
  if (used.size() > 16) return true;  // too many to try
  for (unsigned combination = 0; combination < 1U << used.size(); ++combination) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      facts[static_cast<std::size_t>(used[i])] = static_cast<char>(combination >> i & 1U);
    }
    if (role.guard.holds(facts)) return true;
  }
  return false;
}

Marking after(const PetriTransition& transition, Marking marking) {
  const Marking before = marking;
  fire(transition, marking);
  for (std::size_t i = 0; i < marking.size(); ++i) {
    if (before[i] == kWithoutEnd) marking[i] = kWithoutEnd;
  }
  return marking;
}

bool covers(const Marking& more, const Marking& less) {
  return std::equal(more.begin(), more.end(), less.begin(), [](int a, int b) { return a >= b; });
}

/// The plan's reachability graph, or its coverability tree where tokens can pile up.
class PlanStates {
 public:
  explicit PlanStates(const PetriPlan& plan)
      : plan_(plan), is_possible_(plan.transitions.size()), fires_(plan.transitions.size()) {
    for (std::size_t t = 0; t < is_possible_.size(); ++t) {
      is_possible_[t] = canHold(plan.transitions[t], plan.vocabulary.conditions.size());
    }
    add(initialMarking(plan.net), -1);
    for (std::size_t s = 0; s < states_.size() && states_.size() <= kMostStates; ++s) expand(s);
  }

  const std::vector<State>& states() const { return states_; }
  bool isTooLarge() const { return states_.size() > kMostStates; }
  bool fires(std::size_t transition) const { return fires_[transition]; }
  PlanOutcome outcome(const State& state) const { return outcomeAt(plan_, state.marking); }

 private:
  int add(Marking marking, int parent) {
    for (int above = parent; above >= 0; above = states_[static_cast<std::size_t>(above)].parent) {
      const Marking& less = states_[static_cast<std::size_t>(above)].marking;
      if (marking == less || !covers(marking, less)) continue;
      for (std::size_t i = 0; i < marking.size(); ++i) {
        if (marking[i] > less[i]) marking[i] = kWithoutEnd;
      }
    }
    const auto [found, is_new] = index_.try_emplace(marking, static_cast<int>(states_.size()));
    if (is_new) states_.push_back({std::move(marking), parent, {}});
    return found->second;
  }

  void expand(std::size_t s) {
    if (outcome(states_[s]) != PlanOutcome::kRunning) return;
    for (std::size_t t = 0; t < is_possible_.size(); ++t) {
      const PetriTransition& transition = plan_.net.transitions[t];
      if (!is_possible_[t] || !isEnabled(transition, states_[s].marking)) continue;
      fires_[t] = true;
      const int next = add(after(transition, states_[s].marking), static_cast<int>(s));
      states_[s].next.push_back(next);
    }
  }

  const PetriPlan& plan_;
  std::vector<bool> is_possible_;
  std::vector<bool> fires_;
  std::vector<State> states_;
  std::map<Marking, int> index_;
};

/// Tokens that the transition takes from (or gives to) places where the action runs.
int runningTokens(const PetriPlan& plan, const std::vector<PetriArc>& arcs, int action) {
  int tokens = 0;
  for (const PetriArc& arc : arcs) {
    if (plan.places[static_cast<std::size_t>(arc.place)].action == action) tokens += arc.weight;
  }
  return tokens;
}

/// Interrupts end their action: who starts an action brings its token, who ends it takes it away.
void checkActions(const PetriPlan& plan, std::vector<PlanFault>& faults) {
  for (std::size_t t = 0; t < plan.transitions.size(); ++t) {
    const PetriTransition& transition = plan.net.transitions[t];
    for (int action = 0; action < static_cast<int>(plan.vocabulary.actions.size()); ++action) {
      const int change = runningTokens(plan, transition.gives, action) -
                         runningTokens(plan, transition.takes, action);
      int told = 0;
      for (const ActionCall& call : plan.transitions[t].calls) {
        if (call.action != action) continue;
        const bool starts = call.event == ActionEvent::kStart || call.event == ActionEvent::kResume;
        told += starts ? 1 : -1;
      }
      if (change == told) continue;
      const std::string name = plan.vocabulary.actions[static_cast<std::size_t>(action)];
      const char* reason = told > change ? "' without bringing a token to its place"
                                         : "' without taking the token from its place";
      std::string does = std::string(told > change ? "starts '" : "ends '") + name + reason;
      if (told == 0) {
        does = (change > 0 ? "brings a token to the place of '"
                           : "takes the token from the place of '") +
               name + (change > 0 ? "' but does not start it" : "' but does not end it");
      }
      faults.push_back({PlanFlaw::kActionsOutOfStep, nameInSentence(transition) + " " + does});
    }
  }
}

void checkBounds(const PetriPlan& plan, const PlanStates& states, std::vector<PlanFault>& faults) {
  for (std::size_t p = 0; p < plan.places.size(); ++p) {
    if (std::any_of(states.states().begin(), states.states().end(),
                    [&](const State& s) { return s.marking[p] == kWithoutEnd; })) {
      faults.push_back({PlanFlaw::kUnboundedPlace,
                        nameInSentence(plan.net.places[p]) + " can gather tokens without end"});
    }
  }
}

void checkTransitions(const PetriPlan& plan, const PlanStates& states,
                      std::vector<PlanFault>& faults) {
  for (std::size_t t = 0; t < plan.transitions.size(); ++t) {
    if (states.fires(t)) continue;
    faults.push_back(
        {PlanFlaw::kDeadTransition, nameInSentence(plan.net.transitions[t]) + " can never fire"});
  }
}

std::string placesIn(const PetriPlan& plan, const Marking& marking) {
  std::string list;
  for (std::size_t p = 0; p < marking.size(); ++p) {
    if (marking[p] == 0) continue;
    const PetriPlace& place = plan.net.places[p];
    list += (list.empty() ? "" : ", ") + (place.name.empty() ? place.id : place.name);
  }
  return list.empty() ? "no token anywhere" : "a token on " + list;
}

/// From every state an end must be reachable.
void checkEnds(const PetriPlan& plan, const PlanStates& graph, std::vector<PlanFault>& faults) {
  const auto& states = graph.states();
  std::vector<std::vector<int>> previous(states.size());
  std::vector<int> open;
  std::vector<bool> can_end(states.size());
  bool goal_is_reached = false;
  for (std::size_t s = 0; s < states.size(); ++s) {
    for (const int next : states[s].next) {
      previous[static_cast<std::size_t>(next)].push_back(static_cast<int>(s));
    }
    const PlanOutcome outcome = graph.outcome(states[s]);
    goal_is_reached = goal_is_reached || outcome == PlanOutcome::kReached;
    if (outcome == PlanOutcome::kRunning) continue;
    can_end[s] = true;
    open.push_back(static_cast<int>(s));
  }
  if (!goal_is_reached) {
    const auto wanted = std::find_if(plan.places.begin(), plan.places.end(),
                                     [](const PlaceRole& p) { return p.goal_tokens >= 0; });
    const auto at = static_cast<std::size_t>(wanted - plan.places.begin());
    faults.push_back(
        {PlanFlaw::kNoGoal, wanted == plan.places.end()
                                ? "no place is named 'goal'"
                                : nameInSentence(plan.net.places[at]) + " can never be reached"});
  }
  while (!open.empty()) {
    const auto s = static_cast<std::size_t>(open.back());
    open.pop_back();
    for (const int before : previous[s]) {
      if (can_end[static_cast<std::size_t>(before)]) continue;
      can_end[static_cast<std::size_t>(before)] = true;
      open.push_back(before);
    }
  }
  const auto stuck = std::find(can_end.begin(), can_end.end(), false);
  if (stuck == can_end.end()) return;
  const State& state = states[static_cast<std::size_t>(stuck - can_end.begin())];
  faults.push_back({PlanFlaw::kDeadlock, "with " + placesIn(plan, state.marking) +
                                             " neither goal nor fail can be reached any more"});
}

}  // namespace

PlanReport checkPlan(const PetriPlan& plan) {
  PlanReport report;
  checkActions(plan, report.faults);
  const PlanStates states(plan);
  report.states = states.states().size();
  if (states.isTooLarge()) {
    report.faults.push_back({PlanFlaw::kTooLarge, "the plan can get into more than " +
                                                      std::to_string(kMostStates) + " states"});
    return report;
  }
  const std::size_t before = report.faults.size();
  checkBounds(plan, states, report.faults);
  const bool is_bounded = report.faults.size() == before;
  checkTransitions(plan, states, report.faults);
  if (is_bounded) checkEnds(plan, states, report.faults);
  return report;
}

}  // namespace heel
