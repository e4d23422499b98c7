// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How often which value came, as a drawing of Heel's pages.
#pragma once

#include <string>
#include <vector>

namespace heel {

/// How many values fall in each of `bins` ranges of width `step` from `first` on; values that are
/// not finite are left out, those at the upper end belong to the last range.
std::vector<int> binned(const std::vector<double>& values, double first, double step, int bins);

/// A figure with bars, the middle value and the extremes: HTML around SVG.
std::string histogram(const std::string& title, const std::string& unit,
                      const std::vector<double>& values);

}  // namespace heel
