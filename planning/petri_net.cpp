// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/petri_net.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {

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
