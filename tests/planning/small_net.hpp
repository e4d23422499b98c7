// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Nets for tests, in a line each.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace heel::test {

/// Builds a net by names; places and transitions get theirs as ids too.
class SmallNet {
 public:
  SmallNet& place(const std::string& name, int tokens = 0) {
    net_.places.push_back({name, name, tokens, {}});
    return *this;
  }
  /// A transition between places; a place that is named twice has an arc of weight 2.
  SmallNet& transition(const std::string& name, const std::vector<std::string>& takes,
                       const std::vector<std::string>& gives) {
    PetriTransition t;
    t.id = t.name = name;
    addArcs(takes, t.takes);
    addArcs(gives, t.gives);
    net_.transitions.push_back(t);
    return *this;
  }
  operator PetriNet() const { return net_; }  // NOLINT: reads better without a call

 private:
  void addArcs(const std::vector<std::string>& names, std::vector<PetriArc>& arcs) {
    for (const std::string& name : names) {
      const int place = indexOf(name);
      bool is_known = false;
      for (PetriArc& arc : arcs) {
        if (arc.place != place) continue;
        ++arc.weight;
        is_known = true;
      }
      if (!is_known) arcs.push_back({"arc" + std::to_string(++arcs_), place, 1, {}});
    }
  }
  int indexOf(const std::string& name) const {
    for (std::size_t i = 0; i < net_.places.size(); ++i) {
      if (net_.places[i].name == name) return static_cast<int>(i);
    }
    throw std::invalid_argument("no place " + name);
  }

  PetriNet net_;
  int arcs_ = 0;
};

}  // namespace heel::test
