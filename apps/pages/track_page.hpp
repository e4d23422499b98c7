// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel track` found in a recording, as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/pages/run_page.hpp>
#include <heel/apps/results/track_log.hpp>

#include <string>

namespace heel {

/// The whole page: where the target was and when, why it was not seen, who else was there, and by
/// what it was known. Well-formed as XML too; the same log gives the same bytes.
std::string trackPage(const TrackLog& log, const PageFilm& film = {});

}  // namespace heel
