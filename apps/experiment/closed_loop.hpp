// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The robot follows a person through a simulated home: sensors to mind to wheels, and round again.
#pragma once

#include <heel/apps/experiment/faults.hpp>
#include <heel/apps/experiment/rough_world.hpp>
#include <heel/apps/follower/follower.hpp>
#include <heel/apps/results/follow_log.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace heel {

/// So near to the person at the end of their way for a second, and they are reached.
inline constexpr double kReached_m = 1.5;

struct ClosedLoopParams {
  std::uint64_t seed = 1;
  int threads = 0;         ///< Of the simulator; 0 = as many as the machine has.
  double limit_s = 600.0;  ///< The run ends here, whatever comes.
  double period_s = 0.1;   ///< From one command to the next.
  std::vector<Fault> faults;
  RoughWorld rough;
  bool has_map = true;  ///< Else the robot follows without one.
  FollowerParams follower;
};

/// Told of every step.
using LoopObserver =
    std::function<void(const Readings&, const FollowStep&, const Follower&, const FollowSample&)>;

/// What a simulated robot is, but for its camera's optics and how it is turned.
RobotDescription describeRobot(const RobotParams& params);

/// What a step tells of itself; for the truth there are the estimates.
FollowSample sampleOf(const FollowStep& step, const Follower& follower);

/// Of what a robot without truth reads, what a LoopObserver is shown: the time and the picture.
/// @param picture  Holds it.
Readings shownOf(const RobotReadings& readings, StereoReading& picture);

/// How a run ends with a plan that has: "failed" or "done".
const char* outcomeOf(PlanOutcome outcome);

/// The scene's first person enters and is learned and followed, until they have walked all of their
/// path and the robot is with them ("reached"), the plan fails ("failed") or comes to a goal of its
/// own ("done"), nobody could be learned ("nobody learned"), the time is over ("timeout"), or a
/// signal asked for the end ("stopped"). All randomness comes from the seed.
/// @param plan      A Petri net plan; see loadPlan().
/// @param observer  May draw and time; it can't change anything.
FollowLog runClosedLoop(const Scene& scene, const PetriPlan& plan, const ClosedLoopParams& params,
                        const LoopObserver& observer = {},
                        const Follower::StageDone& stage_done = {});

}  // namespace heel
