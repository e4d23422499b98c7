// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Switches that make a simulated world less kind to the robot.
#pragma once

#include <heel/apps/experiment/faults.hpp>
#include <heel/apps/simulation/scene.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace heel {

/// What is rough; how rough is drawn from the run's seed.
struct RoughWorld {
  bool people = false;  ///< People do not see the robot: see ScenePerson::sees_robot.
  /// Others walk up to 1.6 times as fast, and anybody stops for up to 2 s, about every 7 m.
  bool hurry = false;
  /// Half of the others walk with somebody beside them, who is a child or not.
  bool company = false;
  bool skirts = false;   ///< Half of all wear a long skirt, in which no laser sees legs.
  bool drawers = false;  ///< Cupboards and desks have open drawers that the map does not show.
  /// Doors that the map does not show: some stand open into a room, and where nobody's way leads
  /// some are shut.
  bool doors = false;
  bool steps = false;     ///< Up to three steps down of 0.15 to 0.5 m, where nobody's way leads.
  bool black = false;     ///< A fifth of the furniture is of velvet, which no laser sees.
  bool glass = false;     ///< Of what the map shows a fifth is of glass, which no laser sees.
  bool dropouts = false;  ///< Pictures and scans are missing for 0.2 to 2 s, about every 15 s.
  bool latency = false;   ///< Pictures, scans and the wheels are late, with jitter: see Latencies.
  bool map = false;    ///< In the robot's map furniture is up to 0.1 m off, and a piece is missing.
  bool laser = false;  ///< The laser sees 220 degrees ahead.
  bool light = false;  ///< The camera's light is drawn: see CameraParams::drawn_light.
  bool odometry = false;  ///< Odometry has errors of up to 3 % that stay.
};

/// The switches' names, as a list for people.
const std::string& roughSwitches();

/// @param list  Names with commas between them, or "all"; empty: none.
/// @throws std::invalid_argument  naming the switches, if one is not known.
RoughWorld roughWorldOf(const std::string& list);

/// The scene with what is rough in the world itself; the map is left as it is.
Scene roughened(Scene scene, const RoughWorld& rough, std::uint64_t seed);

/// The scene as the robot's map has it.
Scene asMapped(Scene scene, const RoughWorld& rough, std::uint64_t seed);

/// When the sensors drop out in this time.
std::vector<Fault> dropoutsOf(const RoughWorld& rough, double limit_s, std::uint64_t seed);

/// How late things are: pictures up to 0.1 to 0.25 s, scans 0.04 to 0.1 s, the wheels 0.04 to
/// 0.1 s.
Latencies latenciesOf(const RoughWorld& rough, std::uint64_t seed);

}  // namespace heel
