// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Colours as a scene names them, and as light.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>

namespace heel {

/// Linear red, green and blue: a reflectance in [0, 1], or light.
using Rgb = Eigen::Array3f;

/// Reads "#rrggbb" (sRGB) or one of the names of `colorNames()`.
std::optional<Rgb> parseColor(const std::string& text);

/// The names that `parseColor` knows, with commas between them.
std::string colorNames();

/// sRGB's transfer curve, from a linear value in [0, 1] to a display value in [0, 1].
float toDisplay(float linear);
/// Its inverse.
float toLinear(float display);

}  // namespace heel
