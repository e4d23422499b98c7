// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The results of one recording that was tracked in pieces.
#pragma once

#include <heel/apps/results/result_files.hpp>

#include <cstddef>
#include <vector>

namespace heel {

/// What `heel track` writes of a recording, or of a piece of it: in order of time.
struct TrackTables {
  std::vector<FrameRow> frames;
  std::vector<TrackRow> tracks;
};

/// Where one piece's rows end, and those of the next one begin.
struct Seam {
  std::size_t first_frame = 0;  ///< As the next piece counts.
  std::ptrdiff_t shift = 0;     ///< From how it counts to how the whole does.
};

/// Appends what a piece tells of the time after `whole`. A track of it is that of the whole which
/// is nearest in the last frame that both have, if it is there within half a person's width; else
/// its number is a new one.
/// @throws std::invalid_argument  if a piece has no frames, or the next one does not go on after
///                                the whole.
Seam join(TrackTables& whole, TrackTables next);

}  // namespace heel
