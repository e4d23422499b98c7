// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The last gate before the wheels: no more speed than the robot can brake from before it touches
/// what its sensors saw.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/planning/possible_ways.hpp>
#include <heel/planning/recent_sight.hpp>
#include <heel/planning/trajectory.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// How late the robot acts, and how much room it keeps.
struct LastGateParams {
  DriveLimits limits;  ///< The robot's.
  /// A command acts on the wheels at most so long after it was sent, or at any time before [s].
  double wheels_latency_s = 0.0;
  /// Room that is left to what was seen: two standard deviations of a laser's ranges.
  double margin_m = 0.02;
  RecentSightParams sight;  ///< What its sensors see, and for how long that is known.
};

/// Why a velocity is let through, or not all of it.
enum class GateReason { kFree, kThing, kUnseen, kBadMotion };
const char* describe(GateReason reason);

/// The velocity to drive, and what it was reduced for.
struct GatedVelocity {
  VelocityCommand velocity;
  GateReason reason = GateReason::kFree;
};

/// Takes a velocity and gives one with which the robot stops in time, from raw readings alone:
/// neither the map nor the tracks nor who is followed. The robot is a disc drawn along an axis.
///
/// It lets a velocity through if the robot, with it for a control period and then braking,
/// - comes no nearer than `margin_m` to what was seen, or, where the nearest that it does not touch
///   was nearer at the last odometry, no nearer than that;
/// - does the same with what came, in the last `remembers_s`, to where a look had seen nothing,
///   wherever that may walk to meanwhile, as long as the newest scan sees it; what the robot leaves
///   behind may come as near as it will;
/// - stays as far off the legs of who came in the last half minute, and stands, as a body goes
///   beyond them;
/// - does not drive towards what it touched then, not even as far as it has moved off since;
/// - goes only where scans of the last `remembers_s` have seen, and backwards only where those of
///   the last half second have, for somebody may have come up from behind: all that the body newly
///   covers is looked at, and `margin_m` beyond, for things of 4 cm across or more.
/// Else it scales forward speed and turn alike; else it lets only the turn through; else nothing.
///
/// The first two hold for every way that the robot can take, not for some of them: each command
/// comes to the wheels at any time within `wheels_latency_s`, in the order of sending, and the
/// speed was anything between the measured one and those that the commands can have brought about.
/// A box around all of these ways is followed; it is never too small, and may be too large.
///
/// So what stands still, and was seen before the robot had to brake for it, is not driven into; who
/// walks straight into the robot is met by one that stands, or goes away from them.
/// That needs: the stamps and the odometry's places are right; the wheels change their speed as
/// `limits` say, by no less and no more, and do not slip; a velocity is asked for each control
/// period or more often, and none beyond `limits`; the things are fewer than there is room for
/// (4096 points); and between two beams that end on a thing it does not stand out. A place counts
/// as seen if both beams beside it ended beyond it, and what the body already covers, and 1 mm
/// around it, as free. Of a scanner that looks ahead, the strips beside the body that it can not
/// see of the way straight on are taken on trust, forwards, or the robot could never drive off: 28
/// mm for 180 degrees, 0.12 m ahead of the middle of a body of 0.26 m; none for 220 degrees 0.09 m
/// ahead. So are, where nobody looked, the strips beside a long body into which its ends swing as
/// it turns; what was seen there is known until it is looked at again. No component is ever larger
/// than that which was asked for, nor of the other sign.
///
/// All poses are of the base in one frame that does not jump, the odometry's. Nothing is allocated
/// once as many things have been seen as ever will be.
class LastGate {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit LastGate(const LastGateParams& params);

  /// As those of RecentSight.
  void addScan(const LaserScan& scan, const FloorPose& base, double stamp_s);
  void addPoints(int camera, const std::vector<Eigen::Vector3f>& points, const FloorPose& base,
                 double stamp_s, const std::vector<Eigen::Vector2d>& steps = {});

  const RecentSight& sight() const { return sight_; }

  /// Distance from a place to the nearest thing that was seen, as far as things are kept: a planner
  /// that asks for it plans nothing that the gate holds back. [m]
  double clearance(const Eigen::Vector2d& place) const { return sight_.clearance(place); }

  /// Takes in how the robot moves, and what is near it by then.
  /// @param now    Where the base was by the last odometry, and its speed.
  /// @param age_s  How old that is.
  /// @param now_s  The time at which the velocity is sent, on the clock of the stamps.
  void locate(const DriveState& now, double age_s, double now_s);
  /// Whether it would let a part of a velocity through on its arc, by what was located last.
  bool lets(const VelocityCommand& wanted);

  /// As it is located so, and then sent.
  GatedVelocity pass(const VelocityCommand& wanted, const DriveState& now, double age_s,
                     double now_s);

 private:
  struct Near {
    Eigen::Vector2d place;
    double away_m;  // from the body's axis
    Eigen::Vector2d velocity;
    bool roams;       // it may walk
    double around_m;  // it is a part of somebody, who may be so far around it
    double gait_mps;  // how far off its velocity may be
    double age_s;     // of the place
  };

  void approach(const FloorLine& body, double reach_m);
  double strays(const Near& thing, double after_s) const;
  static bool recedes(const WayPiece& piece, double along_m, double aside_m, double around_m);
  bool isFree(const std::vector<WayPiece>& pieces) const;
  bool isRimSeen(const FloorLine& start, const Eigen::Vector2d& middle,
                 const Eigen::Vector2d& front, double body_m, double stood_m, double since_s);
  double rimStep() const;
  bool isSeenAhead(const std::vector<WayPiece>& pieces);
  GateReason judge(const VelocityCommand& velocity);

  LastGateParams params_;
  RecentSight sight_;
  PossibleWays ways_;
  FloorPose from_;       // of the last odometry,
  double then_s_ = 0.0;  // its time,
  double now_s_ = 0.0;   // and now
  bool is_located_ = false;
  std::vector<Near> near_;  // what can be touched
  double allow_m_ = 0.0;    // how near what it does not touch may come
};

}  // namespace heel
