// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Upright cylinders for Embree, which has none with flat ends.
#pragma once

#include <heel/apps/simulation/embree.hpp>
#include <heel/apps/simulation/geometry.hpp>

namespace heel {

/// Makes a committed geometry of `pillars`, which must outlive it. The caller releases it.
RTCGeometry makePillarGeometry(RTCDevice device, const std::vector<Pillar>& pillars);

}  // namespace heel
