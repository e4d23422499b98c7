// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What frames the pictures of all films: the state above them, the meaning of the marks below.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <string>
#include <vector>

namespace heel {

/// The colour of a tone.
const cv::Scalar& colorOf(Tone tone);

/// The state on a label, why, and at the right end the time.
void drawHeader(const std::string& state, Tone tone, const std::string& reason,
                const std::string& time, cv::Mat& header);

/// A mark and what it means.
struct LegendEntry {
  enum class Mark { kDisc, kRing, kSquare, kLine };
  std::string text;
  cv::Scalar color;
  Mark mark = Mark::kDisc;
};

/// Writes the entries in one row.
void drawLegend(const std::vector<LegendEntry>& entries, cv::Mat& footer);

}  // namespace heel
