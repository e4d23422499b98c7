// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A run of following as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/output/output.hpp>
#include <heel/apps/pages/run_page.hpp>
#include <heel/apps/results/follow_summary.hpp>

#include <filesystem>
#include <string>

namespace heel {

struct FollowPageParams {
  PageFilm film;
  std::size_t most_moments = 1500;  ///< That can be pointed at; the run's others are passed over.
};

/// How an outcome is to be taken, and a sentence's end for it.
Tone toneOf(const std::string& outcome);

/// The whole page, well-formed as XML too. It has no address of anything outside of it but the
/// film's, and is complete without.
std::string followPage(const FollowLog& log, const FollowSummary& summary,
                       const FollowPageParams& params = {});

/// Writes followPage() to a file.
/// @throws OutputError  as OutputFile.
void writeFollowPage(const OutputPath& file, const FollowLog& log, const FollowSummary& summary,
                     const FollowPageParams& params = {});

}  // namespace heel
