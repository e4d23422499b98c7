// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Place/transition nets: what they are made of and how they fire.
#pragma once

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

Marking initialMarking(const PetriNet& net);

/// Whether `marking` has all the tokens that the transition takes.
bool isEnabled(const PetriTransition& transition, const Marking& marking);

/// Takes and gives the transition's tokens.
/// @throws std::invalid_argument  if the transition is not enabled; the marking is then as before.
void fire(const PetriTransition& transition, Marking& marking);

}  // namespace heel
