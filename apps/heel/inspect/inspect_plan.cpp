// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/inspect/inspect.hpp>
#include <heel/apps/pictures/plan_net_picture.hpp>
#include <heel/planning/following_plan.hpp>
#include <heel/planning/plan_checks.hpp>
#include <heel/planning/plan_file.hpp>

#include <cstdio>
#include <string>

namespace heel {
namespace {

std::string listOf(const PetriPlan& plan, const std::vector<PetriArc>& arcs) {
  std::string list;
  for (const PetriArc& arc : arcs) {
    if (!list.empty()) list += " + ";
    if (arc.weight > 1) list += std::to_string(arc.weight) + " ";
    list += plan.net.places[static_cast<std::size_t>(arc.place)].id;
  }
  return list.empty() ? "nothing" : list;
}

}  // namespace

cv::Mat inspectPlan(const std::filesystem::path& file) {
  const PetriPlan plan = loadPlan(file, followingVocabulary());
  const PetriNet& net = plan.net;
  const std::string summary = std::to_string(net.places.size()) + " places, " +
                              std::to_string(net.transitions.size()) + " transitions, " +
                              std::to_string(checkPlan(plan).states) + " states";
  std::printf("plan '%s': %s\n", net.name.c_str(), summary.c_str());
  for (const PetriPlace& place : net.places) {
    std::printf("  place      %-10s %-18s", place.id.c_str(), place.name.c_str());
    if (place.tokens > 0) std::printf(" %d token%s", place.tokens, place.tokens == 1 ? "" : "s");
    std::printf("\n");
  }
  for (const PetriTransition& t : net.transitions) {
    const std::string way = listOf(plan, t.takes) + " -> " + listOf(plan, t.gives);
    std::printf("  transition %-10s %-18s %s\n", t.id.c_str(), way.c_str(), t.name.c_str());
  }
  std::printf(
      "  checked: all names are known, actions start and end with their tokens, no place\n"
      "  gathers tokens, every transition can fire, the goal can be reached, and an end can be\n"
      "  reached from every state\n");
  return drawPlanNet(plan, summary);
}

}  // namespace heel
