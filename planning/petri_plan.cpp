// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/petri_plan.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace heel {

namespace {

constexpr std::array<std::pair<const char*, ActionEvent>, 5> kEvents = {{
    {"start", ActionEvent::kStart},
    {"end", ActionEvent::kEnd},
    {"interrupt", ActionEvent::kInterrupt},
    {"resume", ActionEvent::kResume},
    {"fail", ActionEvent::kFail},
}};

/// The words of a name; what is in brackets is one word.
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = name.find_first_not_of(" \t\r\n", at)) != std::string::npos;) {
    const char last = name[at] == '[' ? ']' : ' ';
    std::size_t end = name.find_first_of(last == ']' ? "]" : " \t\r\n[", at);
    if (end != std::string::npos && last == ']') ++end;
    words.push_back(name.substr(at, end == std::string::npos ? end : end - at));
    at = std::min(end, name.size());
  }
  return words;
}

int indexOf(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

int knownAction(const std::string& name, const PlanVocabulary& vocabulary) {
  const int action = indexOf(vocabulary.actions, name);
  if (action < 0) throw std::runtime_error("names the action '" + name + "', which is unknown");
  return action;
}

/// Tokens that `goal`, `goal(2)` and the like ask for; -1 if the word is another.
int endTokens(const std::string& word, const std::string& end) {
  if (word == end) return 1;
  if (word.rfind(end + "(", 0) != 0 || word.back() != ')') return -1;
  const std::string number = word.substr(end.size() + 1, word.size() - end.size() - 2);
  const bool is_number =
      !number.empty() && number.size() < 7 &&
      std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!is_number) throw std::runtime_error("asks for '" + word + "', which is no number of tokens");
  return std::stoi(number);
}

PlaceRole placeRole(const PetriPlace& place, const PlanVocabulary& vocabulary) {
  PlaceRole role;
  for (const std::string& word : wordsOf(place.name)) {
    const auto dot = word.rfind('.');
    if (dot != std::string::npos && word.substr(dot) == ".exec") {
      if (role.action >= 0) throw std::runtime_error("names two actions");
      role.action = knownAction(word.substr(0, dot), vocabulary);
    }
    role.goal_tokens = std::max(role.goal_tokens, endTokens(word, "goal"));
    role.fail_tokens = std::max(role.fail_tokens, endTokens(word, "fail"));
  }
  return role;
}

/// That all the actions that it ends have ended so.
PlanGuard defaultGuard(const std::vector<ActionCall>& calls, const PlanVocabulary& vocabulary) {
  std::vector<std::string> ends;
  for (const ActionCall& call : calls) {
    const std::string& action = vocabulary.actions[static_cast<std::size_t>(call.action)];
    if (call.event == ActionEvent::kEnd) ends.push_back(action + ".finished");
    if (call.event == ActionEvent::kFail) ends.push_back(action + ".failed");
  }
  if (ends.empty()) return {};
  std::string text = ends.size() > 1 ? "and" : "";
  for (const std::string& end : ends) text += (text.empty() ? "" : " ") + end;
  return PlanGuard(text, vocabulary.conditions);
}

TransitionRole transitionRole(const PetriTransition& transition, const PlanVocabulary& vocabulary) {
  TransitionRole role;
  for (const std::string& word : wordsOf(transition.name)) {
    if (word.front() == '[') {
      if (word.back() != ']') throw std::runtime_error("has a guard that does not close");
      if (!role.guard.text().empty()) throw std::runtime_error("has two guards");
      role.guard = PlanGuard(word.substr(1, word.size() - 2), vocabulary.conditions);
      continue;
    }
    const auto dot = word.rfind('.');
    if (dot == std::string::npos) continue;  // a label for the reader
    const std::string event = word.substr(dot + 1);
    const auto found = std::find_if(kEvents.begin(), kEvents.end(),
                                    [&](const auto& known) { return event == known.first; });
    if (found == kEvents.end()) {
      throw std::runtime_error("names the event '" + event + "', which is unknown");
    }
    role.calls.push_back({knownAction(word.substr(0, dot), vocabulary), found->second});
  }
  if (role.guard.text().empty()) role.guard = defaultGuard(role.calls, vocabulary);
  return role;
}

/// Reads one element's role; an error gets the element as its subject.
template <typename Role, typename Element>
Role roleOf(Role (&read)(const Element&, const PlanVocabulary&), const Element& element,
            const PlanVocabulary& vocabulary) {
  try {
    return read(element, vocabulary);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(nameInSentence(element) + " " + error.what());
  }
}

std::string named(const char* kind, const std::string& id, const std::string& name) {
  return std::string(kind) + " '" + id + "'" + (name.empty() ? "" : " (" + name + ")");
}

/// Whether there is such an end in the plan, and its tokens are on each of its places.
bool hasEnded(const PetriPlan& plan, const Marking& marking, int PlaceRole::*wanted) {
  bool is_asked = false;
  for (std::size_t i = 0; i < plan.places.size(); ++i) {
    const int tokens = plan.places[i].*wanted;
    if (tokens < 0) continue;
    if (marking[i] != tokens) return false;
    is_asked = true;
  }
  return is_asked;
}

}  // namespace

PetriPlan makePlan(PetriNet net, const PlanVocabulary& vocabulary) {
  PetriPlan plan;
  plan.vocabulary = vocabulary;
  plan.net = std::move(net);
  for (const PetriPlace& place : plan.net.places) {
    plan.places.push_back(roleOf(placeRole, place, vocabulary));
  }
  for (const PetriTransition& transition : plan.net.transitions) {
    plan.transitions.push_back(roleOf(transitionRole, transition, vocabulary));
  }
  return plan;
}

PlanOutcome outcomeAt(const PetriPlan& plan, const Marking& marking) {
  if (hasEnded(plan, marking, &PlaceRole::goal_tokens)) return PlanOutcome::kReached;
  if (hasEnded(plan, marking, &PlaceRole::fail_tokens)) return PlanOutcome::kFailed;
  return PlanOutcome::kRunning;
}

const char* nameOf(ActionEvent event) {
  return std::find_if(kEvents.begin(), kEvents.end(),
                      [&](const auto& known) { return known.second == event; })
      ->first;
}

std::string nameInSentence(const PetriPlace& place) { return named("place", place.id, place.name); }

std::string nameInSentence(const PetriTransition& transition) {
  return named("transition", transition.id, transition.name);
}

namespace {

int& tokensOn(Marking& marking, int place) { return marking[static_cast<std::size_t>(place)]; }

}  // namespace

Marking initialMarking(const PetriNet& net) {
  Marking marking(net.places.size());
  std::transform(net.places.begin(), net.places.end(), marking.begin(),
                 [](const PetriPlace& place) { return place.tokens; });
  return marking;
}

bool isEnabled(const PetriTransition& transition, const Marking& marking) {
  return std::all_of(transition.takes.begin(), transition.takes.end(), [&](const PetriArc& arc) {
    return marking[static_cast<std::size_t>(arc.place)] >= arc.weight;
  });
}

void fire(const PetriTransition& transition, Marking& marking) {
  if (!isEnabled(transition, marking)) {
    throw std::invalid_argument("transition " + transition.id + " fires without its tokens");
  }
  for (const PetriArc& arc : transition.takes) tokensOn(marking, arc.place) -= arc.weight;
  for (const PetriArc& arc : transition.gives) tokensOn(marking, arc.place) += arc.weight;
}

}  // namespace heel
