// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The camera that an organized cloud came from.
#pragma once

#include <heel/cloud/color_cloud.hpp>

#include <optional>

namespace heel {

/// Fits u = fx X / Z + cx and v = fy Y / Z + cy to an organized cloud in the optical frame, by
/// least squares over all its points.
///
/// @return The camera, or nothing if the cloud is not organized, has less than three points or all
///         in one row or column, which determine no camera, or does not come from one pinhole
///         camera (the residual is over half a pixel, root mean square).
std::optional<PinholeCamera> fitPinhole(const ColorCloud& cloud);

}  // namespace heel
