// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A world that runs: people walk, the robot drives, its sensors measure.
#pragma once

#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/drive_base.hpp>
#include <heel/apps/simulation/laser.hpp>
#include <heel/apps/simulation/renderer.hpp>
#include <heel/apps/simulation/walker.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// How a simulation is run; none of it changes the world but the seed.
struct SimulatorOptions {
  std::uint64_t seed = 1;  ///< Of all noise.
  int threads = 0;         ///< 0 = as many as the machine has; results do not depend on it.
  bool render = true;      ///< Without it there are no stereo readings, and all is much faster.
  /// A command acts on the wheels between half of this and all of it after it was given, drawn.
  double wheels_latency_s = 0.0;
};

/// What the stereo cameras see at one moment, and what is true of it.
struct StereoReading {
  cv::Mat left_bgr;   ///< CV_8UC3, rectified.
  cv::Mat right_bgr;  ///< CV_8UC3.
  cv::Mat depth_m;    ///< Truth of the left view: CV_32FC1, NaN where there is nothing.
  cv::Mat people;     ///< Truth: CV_8UC1, 0, or 1 + the number of the person in the scene.
};

/// Where someone truly is.
struct PersonTruth {
  std::string name;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< World frame, under the hips [m].
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< World frame [m/s].
  double yaw_rad = 0.0;
  bool is_done = false;  ///< Has walked all of their path.
};

/// How things truly are.
struct WorldTruth {
  FloorPose robot;  ///< World frame.
  VelocityCommand robot_speed;
  std::vector<PersonTruth> people;
  double clearance_m = 0.0;  ///< From the robot's rim to the nearest thing or person.
  bool contact = false;      ///< Whether the robot touched anything since the last step.
  /// Whether the robot moved towards what it touched then, at more than 0.02 m/s; things that are
  /// not people are always touched by the robot.
  bool contact_by_robot = false;
};

/// All that a step yields. A sensor that did not measure is null or absent.
struct Readings {
  double stamp_s = 0.0;
  const StereoReading* stereo = nullptr;  ///< Valid until the next step.
  const LaserScan* laser = nullptr;       ///< Valid until the next step.
  /// Of the camera that looks at the floor: CV_32FC1, NaN = none; valid until the next step.
  const cv::Mat* floor_depth_m = nullptr;
  std::optional<FloorPose> odometry;  ///< Since the start, drifting; frame of the first pose.
  WorldTruth truth;
};

/// A scene, living. The same scene, seed and commands give the same readings, bit by bit, on any
/// number of threads.
class Simulator {
 public:
  /// Works out the still light, which takes up to a few seconds for a flat.
  explicit Simulator(Scene scene, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Lets `dt_s` pass while the robot obeys `command`, then reads the sensors whose time has come.
  /// step(0) at the start gives the readings of time 0.
  /// @throws std::invalid_argument  if dt_s is negative or no multiple of 0.01 s.
  const Readings& step(double dt_s, const VelocityCommand& command = {});

  const Scene& scene() const;
  /// What the stereo images measure.
  StereoCamera camera() const;
  /// Maps the left camera's optical frame to the robot's base frame.
  Eigen::Isometry3d T_base_camera() const;
  bool everyoneIsDone() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace heel
