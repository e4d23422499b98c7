// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A part of a recording.
#pragma once

#include <cmath>
#include <limits>

namespace heel {

/// Stamps are decimal fractions: their sums are not exact.
inline constexpr double kSameTime_s = 1e-6;

/// Which part of a recording is read. Both times count from its beginning; a bag begins when its
/// first message was recorded.
struct TimeSpan {
  double from_s = 0.0;                                    ///< From here on.
  double to_s = std::numeric_limits<double>::infinity();  ///< Up to here; both ends are read.

  bool isAll() const { return from_s <= 0.0 && std::isinf(to_s); }
};

}  // namespace heel
