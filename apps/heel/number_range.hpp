// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Checks of numbers that a user gives.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace heel {

/// Like CLI::Range, which lets "nan" through.
inline CLI::Validator between(double low, double high) {
  const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high);
  return {[=](std::string& text) {
            double value = 0.0;
            const bool is_within =
                CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
            return is_within ? std::string() : "'" + text + "' is not a number from " + range;
          },
          "FLOAT:" + range};
}

}  // namespace heel
