// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A Petri Net Plan from its file, checked.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <filesystem>

namespace heel {

/// Reads a plan and proves what can be proved of it (plan_checks.hpp).
/// @throws std::runtime_error  with one sentence that names the file, the element and the reason:
///         whatever readPnml(), makePlan() or checkPlan() find first.
PetriPlan loadPlan(const std::filesystem::path& file, const PlanVocabulary& vocabulary);

}  // namespace heel
