// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The camera that an organized cloud was made with.
#pragma once

#include "cloud/color_cloud.hpp"
#include "cloud/pinhole_camera.hpp"

#include <optional>

namespace heel {

/// Finds the intrinsics of the camera from where the points of an organized cloud lie: PCD files
/// do not store them. Least squares on u = fx x / z + cx and v = fy y / z + cy.
///
/// @param cloud  In the camera's optical frame.
/// @return Absent if the cloud is not organized, has too few points, or lies otherwise: its points
///         then miss their pixels by more than one, root mean square, for instance because the
///         cloud is in another frame.
std::optional<PinholeCamera> cameraOfCloud(const ColorCloud& cloud);

}  // namespace heel
