// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Petri Net Plans: a net whose names say which actions run and when.
///
/// V. Ziparo, L. Iocchi, P. Lima, D. Nardi, P. Palamara: Petri Net Plans, AAMAS 2011. The names are
/// those of their library:
/// - place `follow.exec`: the action `follow` runs while there is a token on it;
/// - place `goal` or `fail`: the plan has ended when the token is here (`goal(2)`: two tokens);
/// - transition `follow.interrupt face.start [near]`: when `near` holds, the one action is
///   interrupted and the other starts. The events are start, end, interrupt, resume and fail.
///   Without a guard `follow.end` waits for the condition `follow.finished`, and `follow.fail` for
///   `follow.failed`.
#pragma once

#include <heel/planning/plan_guard.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Tokens on each place, by the place's index.
using Marking = std::vector<int>;

/// How a place or transition is drawn, in the file's own units, y down.
struct NetGraphics {
  std::optional<Eigen::Vector2d> position;
  Eigen::Vector2d label_offset = Eigen::Vector2d::Zero();  ///< Of the name, from its usual place.
};

/// Where tokens lie.
struct PetriPlace {
  std::string id;    ///< Unique in its net.
  std::string name;  ///< May be empty.
  int tokens = 0;    ///< At the start.
  NetGraphics graphics;
};

/// A bundle of `weight` tokens that a transition takes from, or gives to, a place.
struct PetriArc {
  std::string id;
  int place = 0;
  int weight = 1;
  std::vector<Eigen::Vector2d> bends;  ///< Where the drawn line bends, from source to target.
};

/// Takes tokens from places, and gives them to others.
struct PetriTransition {
  std::string id;
  std::string name;
  NetGraphics graphics;
  std::vector<PetriArc> takes;  ///< At most one arc per place.
  std::vector<PetriArc> gives;  ///< At most one arc per place.
};

/// A net is data. The order of transitions is theirs in the file.
struct PetriNet {
  std::string id;
  std::string name;
  std::vector<PetriPlace> places;
  std::vector<PetriTransition> transitions;
};

/// The tokens at the start.
Marking initialMarking(const PetriNet& net);

/// Whether `marking` has all the tokens that the transition takes.
bool isEnabled(const PetriTransition& transition, const Marking& marking);

/// Takes and gives the transition's tokens.
/// @throws std::invalid_argument  if the transition is not enabled; the marking is then as before.
void fire(const PetriTransition& transition, Marking& marking);

/// The names that a plan may use; actions and conditions are known by their index from here on.
struct PlanVocabulary {
  std::vector<std::string> actions;
  std::vector<std::string> conditions;
};

enum class ActionEvent { kStart, kEnd, kInterrupt, kResume, kFail };

/// What a transition tells an action.
struct ActionCall {
  int action = 0;
  ActionEvent event = ActionEvent::kStart;
};

/// What a place means.
struct PlaceRole {
  int action = -1;       ///< That runs while there is a token here; -1 for none.
  int goal_tokens = -1;  ///< With as many here, the goal is reached; -1 if it does not matter.
  int fail_tokens = -1;  ///< With as many here, the plan has failed; -1 if it does not matter.
};

/// What a transition means.
struct TransitionRole {
  std::vector<ActionCall> calls;
  PlanGuard guard;
};

enum class PlanOutcome { kRunning, kReached, kFailed };

/// A net with the meaning of its names.
struct PetriPlan {
  PlanVocabulary vocabulary;
  PetriNet net;
  std::vector<PlaceRole> places;            ///< Of the net's places.
  std::vector<TransitionRole> transitions;  ///< Of the net's transitions.
};

/// Finds out what a net's names mean.
/// @throws std::runtime_error  with one sentence that names the element: an action, event or
///         condition that is unknown, a guard that makes no sense.
PetriPlan makePlan(PetriNet net, const PlanVocabulary& vocabulary);

/// The plan's state at a marking. Where several places say `goal`, each must have its tokens.
PlanOutcome outcomeAt(const PetriPlan& plan, const Marking& marking);

/// The word for an event in a plan.
const char* nameOf(ActionEvent event);

/// An element as errors name it: `transition 't3' (face.start [near])`.
std::string nameInSentence(const PetriPlace& place);
std::string nameInSentence(const PetriTransition& transition);

}  // namespace heel
