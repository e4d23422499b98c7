// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What most parameters have in common: they are numbers, and not negative.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>

namespace heel {

/// @throws std::invalid_argument  if a value is negative or no number; the text names the struct.
inline void requireNotNegative(const char* name, std::initializer_list<double> values) {
  for (const double value : values) {
    if (!(value >= 0.0)) {
      throw std::invalid_argument(std::string(name) + ": a parameter is negative or no number");
    }
  }
}

}  // namespace heel
