// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The paper's geometric filtering, with the map of a simulated scene.
#pragma once

#include "apps/simulation/scene.hpp"
#include "cloud/color_cloud.hpp"
#include "tracking/geometric_gate.hpp"

namespace heel {

/// Refuses what lies outside the flat, or in or at what the robot's map shows: nobody's middle
/// comes nearer than that to a wall, and the further away, the less is sure about a distance.
/// For a robot that stands still at its start; places are in its base frame.
GeometricGate mapGate(const Scene& scene, const StereoCamera& camera);

}  // namespace heel
