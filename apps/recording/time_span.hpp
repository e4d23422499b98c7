// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A part of a recording.
#pragma once

#include <limits>

namespace heel {

/// From when to when a recording is read; both count from its beginning, which in a bag is when the
/// first message was recorded. [s]
struct TimeSpan {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();

  bool isAll() const { return from_s <= 0.0 && to_s == std::numeric_limits<double>::infinity(); }
};

}  // namespace heel
