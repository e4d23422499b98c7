// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What can go wrong with a robot's sensors, done to a simulated one.
#pragma once

#include <heel/apps/follower/sensor_watch.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <cstdint>
#include <deque>
#include <vector>

namespace heel {

/// Something that is wrong for a while.
struct Fault {
  enum class Kind {
    kNoCamera,       ///< No images of any camera.
    kNoLaser,        ///< No scans.
    kWheelsSlip,     ///< The wheels turn a third faster than the robot moves, and to the left.
    kNoise,          ///< Images of noise.
    kLightsOut,      ///< Black images.
    kPairOutOfStep,  ///< The right image is older than the left.
    kClockJumps,     ///< All stamps are an hour later.
    kClockBack,      ///< All stamps are a second and a half earlier.
  };
  Kind kind = Kind::kNoCamera;
  double from_s = 0.0;
  double to_s = 0.0;
};

/// How late readings come at most, and commands act [s]: each by between half of it and all of it,
/// drawn. None overtakes another of its sensor. The stamps are those of the measuring.
struct Latencies {
  double camera_s = 0.0;
  double laser_s = 0.0;
  double wheels_s = 0.0;  ///< Of the odometry, and of the commands.
};

/// What a robot with these faults reads. Holds copies of what it changes.
class FaultySensors {
 public:
  explicit FaultySensors(std::vector<Fault> faults, std::uint64_t seed = 1,
                         const Latencies& latencies = {})
      : faults_(std::move(faults)), latencies_(latencies), seed_(seed) {}

  /// What is read of the simulator's true readings; valid until the next call.
  const RobotReadings& read(const Readings& readings);

 private:
  const Fault* active(Fault::Kind kind, double stamp_s) const;
  void readImages(const Readings& readings);
  void readOdometry(const Readings& readings);
  void comeLate(double now_s);

  /// Readings of one sensor on their way.
  template <typename Reading>
  struct Queue {
    struct Late {
      double comes_s;
      double stamp_s;
      Reading reading;
    };
    std::deque<Late> on_their_way;
    std::optional<Late> come;  // the newest that has come since the step before

    void put(double comes_s, double stamp_s, Reading reading);
    /// Whether something has come by now.
    bool take(double now_s);
  };
  struct Picture {
    Frame frame;
    double pair_gap_s;
  };

  std::vector<Fault> faults_;
  Latencies latencies_;
  Queue<Picture> pictures_;
  Queue<Frame> floors_;
  Queue<LaserScan> scans_;
  Queue<FloorPose> odometries_;
  std::uint64_t readings_ = 0;
  std::uint64_t seed_;
  RobotReadings result_;
  Frame frame_, floor_;
  cv::Mat older_right_;
  std::optional<FloorPose> true_odometry_, odometry_;
};

}  // namespace heel
