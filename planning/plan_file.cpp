// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/plan_checks.hpp>
#include <heel/planning/plan_file.hpp>
#include <heel/planning/pnml_file.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

namespace {

PetriPlan makePlanOf(const std::filesystem::path& file, const PlanVocabulary& vocabulary) {
  PetriNet net = readPnml(file);
  try {
    return makePlan(std::move(net), vocabulary);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace

PetriPlan loadPlan(const std::filesystem::path& file, const PlanVocabulary& vocabulary) {
  PetriPlan plan = makePlanOf(file, vocabulary);
  const PlanReport report = checkPlan(plan);
  if (!report.faults.empty()) {
    throw std::runtime_error(file.string() + ": " + report.faults.front().sentence);
  }
  return plan;
}

}  // namespace heel
