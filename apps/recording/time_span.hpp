// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A part of a recording.
#pragma once

#include <algorithm>
#include <limits>

namespace heel {

/// Stamps are decimal fractions: their sums are not exact.
inline constexpr double kSameTime_s = 1e-6;

/// Which part of a recording is read. Both times count from its beginning; a bag begins when its
/// first message was recorded.
struct TimeSpan {
  double from_s = 0.0;                                    ///< From here on.
  double to_s = std::numeric_limits<double>::infinity();  ///< Up to here; both ends are read.
};

/// One of the pieces, all as long, that a recording is cut into.
struct RecordingPiece {
  int number = 1;  ///< From 1.
  int count = 1;
  double overlap_s = 60.0;  ///< It begins so long before its time, where there is a piece before.

  TimeSpan spanOf(double duration_s) const {
    const double length_s = duration_s / count;
    const bool is_last = number == count;
    return {std::max(0.0, (number - 1) * length_s - overlap_s),
            is_last ? std::numeric_limits<double>::infinity() : number * length_s};
  }
};

}  // namespace heel
