// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Many runs as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/results/run_table.hpp>

#include <cstddef>
#include <string>

namespace heel {

/// Which runs are shown as the worst.
struct WorstRuns {
  std::string column;         ///< A figure of the table; empty: none are shown.
  bool highest_first = true;  ///< Whether much of it is bad.
  std::size_t count = 12;
};

/// The whole page, well-formed as XML too, without an address of anything outside of it: what
/// failed and why, how the figures are spread, and the worst runs with a picture and the call that
/// shows them again.
std::string summaryPage(const RunTable& table, const WorstRuns& worst);

}  // namespace heel
