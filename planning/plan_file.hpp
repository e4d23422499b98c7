// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Petri Net Plans in files: PNML, the exchange format of ISO/IEC 15909-2, and what is checked.
///
/// Two dialects are read: the standard's (labels in `<text>`, elements in a `<page>`) and the older
/// one of Petri Net Plans and JARP (labels in `<value>`, elements directly in the `<net>`). The
/// second is written, because the tools of Petri Net Plans read no other.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <filesystem>
#include <string>

namespace heel {

/// Reads the one net of a file.
/// @throws std::runtime_error  with one sentence that names the file, the element and the reason:
///         not XML, not PNML, no net or two, an element without an id or name, an id used twice, an
///         arc from or to nowhere, a number that is none, or no token anywhere at the start.
PetriNet readPnml(const std::filesystem::path& file);

/// The net as a PNML document; readPnml() of it gives the same net.
std::string toPnml(const PetriNet& net);

/// Reads a plan and proves what can be proved of it (plan_checks.hpp).
/// @throws std::runtime_error  with one sentence that names the file, the element and the reason:
///         whatever readPnml(), makePlan() or checkPlan() find first.
PetriPlan loadPlan(const std::filesystem::path& file, const PlanVocabulary& vocabulary);

}  // namespace heel
