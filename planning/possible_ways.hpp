// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// All ways that a robot can take from where it was measured until it stands.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace heel {

/// A box that the body's axis does not leave for a while: along a way from a place, and aside.
struct WayPiece {
  Eigen::Vector2d from, way;
  double first_m, last_m, aside_m;
  double turned_rad;             ///< The heading is off the way by no more than this.
  double driven_m;               ///< By any point of the axis no more, since the last odometry.
  double time_s;                 ///< At its end, since then.
  bool advances, backs, swings;  ///< Maybe; swings: its ends move aside.
};

/// Keeps what was sent to the wheels, and follows a box around all ways that this can lead to: each
/// command comes to the wheels at any time within the latency, in the order of sending, and the
/// speed was anything between the measured one and those that the commands can have brought about.
/// The box is never too small, and may be too large.
class PossibleWays {
 public:
  /// @param latency_s  A command acts at most so long after it was sent, or at any time before.
  PossibleWays(const DriveLimits& limits, double latency_s);

  void send(const VelocityCommand& velocity, double now_s);

  /// Odometry tells the mean speed of a while, and late; what was sent, what the speed is by now.
  void believe(const VelocityCommand& measured, double at_s);

  /// The greatest speed that may be driven from then on, by what was measured and sent [m/s].
  double fastest_mps(double then_s) const;

  /// From a pose at a time, which is that of the last believe(), through what was sent, a velocity
  /// that is sent now for a control period, and the brakes. Valid until the next call.
  const std::vector<WayPiece>& layOut(const VelocityCommand& velocity, const FloorPose& from,
                                      double then_s, double now_s);

 private:
  struct Sent {
    double stamp_s;
    VelocityCommand velocity;
  };
  struct Obeyed {
    double until_s;
    VelocityCommand least, most;
  };
  Obeyed obeyed(double time_s, const Sent* planned) const;

  DriveLimits limits_;
  double latency_s_;
  std::array<Sent, 32> sent_;  // a ring
  std::size_t sent_newest_ = 0;
  VelocityCommand least_, most_;  // between these the commands should have brought the speed,
  double believed_s_;             // and when
  VelocityCommand slow_, fast_;   // and between these it is, by the odometry too
  std::vector<WayPiece> pieces_;
};

}  // namespace heel
