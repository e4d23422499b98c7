// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A simulated robot on the network.
#pragma once

#include <heel/apps/live/live_network.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <cstddef>
#include <functional>

namespace heel {

struct LiveSimulationParams {
  double duration_s = 600.0;  ///< Simulated; it also ends when isStopRequested().
  double speed = 1.0;         ///< Simulated seconds a second, if the machine keeps up.
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has.
  /// The base stops when no command has come for so long, as real ones do.
  double command_timeout_s = 0.5;
  std::function<void(const WorldTruth&, double stamp_s)> progress;  ///< May be empty.
};

/// How a run went, by its truth.
struct LiveSimulationResult {
  double duration_s = 0.0;
  std::size_t commands = 0;
  int contacts = 0, contacts_by_robot = 0;
  double way_m = 0.0;              ///< That the robot drove.
  double person_distance_m = 0.0;  ///< To the scene's first person, at the end.
  bool everyone_is_done = false;   ///< Have walked all of their ways.
  double slowest = 0.0;            ///< Real seconds a simulated one, of the slowest ten.
};

/// Sends what the scene's robot measures (see SensorBag; images are raw, the truth is not sent),
/// and drives as /cmd_vel (geometry_msgs/Twist) tells.
LiveSimulationResult runLiveSimulation(const Scene& scene, const LiveSimulationParams& params,
                                       LiveNetwork& network);

}  // namespace heel
