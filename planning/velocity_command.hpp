// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot on wheels is told to do.
#pragma once

namespace heel {

/// A speed along the robot's heading and a turn.
struct VelocityCommand {
  double forward_mps = 0.0;
  double turn_radps = 0.0;  ///< To the left is positive.
};

}  // namespace heel
