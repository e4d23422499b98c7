// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A robot among posts that obeys senseless commands through the last gate.
#pragma once

#include <cstdint>

namespace heel::test {

/// Less than this is the width of the gap between two beams, no touch.
inline constexpr double kGateTouches_m = 0.002;

/// What came of a trial.
struct GateTrial {
  double deepest_m = 0.0;   ///< How far the robot was driven into a post, or further into one.
  bool adds_speed = false;  ///< A component was larger than asked for, or of the other sign.
  int situations = 0;       ///< Velocities that were asked for.
  int held_back = 0;        ///< Those that were not let through as they were.
  double way_m = 0.0;       ///< What it drove.
};

/// Robot, posts, latencies and commands are drawn from the seed; each trial is of 20 control
/// periods. The scanner looks all around, or 220 degrees ahead; posts count that it has seen. All
/// stamps are true, readings come as late as is said. With odd seeds each command comes as late as
/// is said, with even ones earlier too, each as it happens; with seeds that leave 2 or 3 when
/// divided by 4 odometry tells the speed, else its mean over the last period; of 16 seeds one after
/// the other 8 have a long body.
GateTrial runGateTrial(std::uint64_t seed);

}  // namespace heel::test
