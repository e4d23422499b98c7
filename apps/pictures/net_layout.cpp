// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/plan_net_picture.hpp>

#include <algorithm>
#include <map>

namespace heel {

namespace {

constexpr double kColumn = 150.0;
constexpr double kRow = 130.0;

template <typename Nodes>
bool arePlaced(const Nodes& nodes) {
  return std::all_of(nodes.begin(), nodes.end(),
                     [](const auto& node) { return node.graphics.position.has_value(); });
}

/// Which column each node is in: how many steps a token takes to get there. Places come first.
std::vector<int> columnsOf(const PetriNet& net) {
  const std::size_t places = net.places.size();
  std::vector<int> column(places + net.transitions.size(), -1);
  for (std::size_t p = 0; p < places; ++p) {
    if (net.places[p].tokens > 0) column[p] = 0;
  }
  const auto lower = [&](std::size_t node, int value) {
    const bool is_lower = column[node] < 0 || column[node] > value;
    if (is_lower) column[node] = value;
    return is_lower;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t t = 0; t < net.transitions.size(); ++t) {
      for (const PetriArc& arc : net.transitions[t].takes) {
        const int from = column[static_cast<std::size_t>(arc.place)];
        if (from >= 0) changed |= lower(places + t, from + 1);
      }
      if (net.transitions[t].takes.empty()) changed |= lower(places + t, 0);
      if (column[places + t] < 0) continue;
      for (const PetriArc& arc : net.transitions[t].gives) {
        changed |= lower(static_cast<std::size_t>(arc.place), column[places + t] + 1);
      }
    }
  }
  const int last = *std::max_element(column.begin(), column.end());
  std::replace(column.begin(), column.end(), -1, last + 1);  // where no token gets
  return column;
}

}  // namespace

NetLayout layoutNet(const PetriNet& net) {
  NetLayout layout;
  if (arePlaced(net.places) && arePlaced(net.transitions)) {
    for (const PetriPlace& p : net.places) layout.places.push_back(*p.graphics.position);
    for (const PetriTransition& t : net.transitions) {
      layout.transitions.push_back(*t.graphics.position);
    }
    return layout;
  }
  std::map<int, int> used;  // rows taken, by column
  const std::vector<int> column = columnsOf(net);
  for (std::size_t node = 0; node < column.size(); ++node) {
    // Odd columns are a little lower, so that a line past a node is not a line through it.
    const double row = used[column[node]]++ + (column[node] % 2 == 0 ? 0.0 : 0.3);
    auto& nodes = node < net.places.size() ? layout.places : layout.transitions;
    nodes.emplace_back(kColumn * column[node], kRow * row);
  }
  return layout;
}

}  // namespace heel
