// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A simulation as a recording that the other commands read.
#pragma once

#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <filesystem>
#include <functional>
#include <optional>

namespace heel {

/// What to record, and where.
struct SimulateOptions {
  std::filesystem::path out;  ///< Folder; made here, and it must not hold anything yet.
  std::filesystem::path bag;  ///< Also a bag with the same images and readings; may be empty.
  std::optional<double> duration_s;  ///< Else the scene's own.
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has.
  /// Told before each step how things are, it drives the robot; empty: the robot stands still.
  std::function<VelocityCommand(const WorldTruth&)> drive;
  std::function<void(double)> progress;  ///< Called with the share that is done; may be empty.
};

/// The longest step, in whole ticks of the simulator, that skips no measurement of any sensor [s].
double stepFor(const RobotParams& robot);

/// Begins to write what a simulated robot measures.
SensorBag sensorBag(std::unique_ptr<BagWriter> bag, const Simulator& simulator,
                    bool packs_images = true);

/// Adds what the sensors read: odometry first, then what is measured from where it says.
void addTo(SensorBag& bag, const Readings& readings);

/// What was recorded.
struct SimulateResult {
  std::size_t frames = 0;
  double duration_s = 0.0;
  bool complete = true;  ///< False if a signal ended it before.
};

/// Runs a scene and writes a recording:
///
/// | file | holds |
/// | --- | --- |
/// | `left/`, `right/` | rectified images, 000001.png and so on |
/// | `times.txt` | their stamps, one a line |
/// | `stereo.yaml` | projection matrices P1, P2, for OpenCV |
/// | `camera.yaml` | intrinsics, and `T_ground_camera` at the start |
/// | `truth.csv` | `stamp_s,frame,person,x_m,y_m,exact`: everyone in view, in the ground frame (the
///   robot's base frame at the start); exact = 0 where less than a quarter of them is seen |
/// | `truth_map.csv` | the same in the scene's frame, which its maps have |
/// | `people.csv`, `robot.csv` | everyone's and the robot's place in the world, seen or not |
/// | `scan.csv`, `odometry.csv` | laser ranges and wheel odometry |
/// | `summary.json` | how much there is, and whether it is complete |
/// | `truth/depth/`, `truth/people/` | 16-bit depth in 0.1 mm steps (0 = none); 0, or 1 + the
///   number of the person |
///
/// The folder appears when all is done. isStopRequested() ends it early; without a frame, nothing
/// is written. The bag (see SensorBag) has the same images, the readings of the laser and of the
/// odometry as they were measured, and the truth of the robot and people.
/// @throws std::invalid_argument  one sentence, if the duration is none or `out` holds something.
/// @throws OutputError  if `out` can't be written.
SimulateResult simulate(const Scene& scene, const SimulateOptions& options);

}  // namespace heel
