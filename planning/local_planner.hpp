// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Obstacle avoidance: the next command towards the goal that touches nothing.
#pragma once

#include <heel/planning/drive_terms.hpp>
#include <heel/planning/trajectory.hpp>

#include <optional>
#include <vector>

namespace heel {

/// Which motions are tried, and how they are rated.
struct LocalPlannerParams {
  DriveLimits limits;
  DriveTermParams terms;
  FacingParams facing;
  double horizon_s = 4.0;  ///< How far into the future the tried motions reach.
  double margin_m = 0.04;  ///< Room that is left to things when the robot has braked.
  /// Room that is left to people when the robot has braked, wherever on their way they are then.
  double people_margin_m = 0.1;
  double slow_gap_m = 0.08;       ///< With less room to things than this the robot slows down.
  double least_speed_mps = 0.08;  ///< It slows down no further than to this.
  /// People may walk at the robot at any moment, and gain speed up to this: it comes towards them
  /// only as fast as lets it stand when they reach it; beside them at `least_speed_mps`. A
  /// comfortable walk (Bohannon, Age and Ageing 26, 1997).
  double walks_mps = 1.3;
  /// Who is hidden may come out as fast as this at any moment; there it drives at `least_speed_mps`
  /// or more. A walk about the house: at `walks_mps` it would slow down at every edge.
  double appears_mps = 0.7;
  /// From somebody's step until the robot begins to brake: that of the sensors, of the wheels, and
  /// two control periods.
  double reacts_s = 0.2;
  /// A robot that has stood so long to keep a person in view may turn away from them.
  double look_away_s = 0.5;
  double give_way_gap_m = 0.2;  ///< The robot backs off when a person will come nearer than this.
  double give_way_s = 1.2;      ///< How far ahead in time give_way_gap_m is looked for.
  /// The robot has arrived when it is nearer than this to the path's end.
  double arrive_m = 0.08;
  /// A robot that has arrived drives again when the end is further away than this.
  double depart_m = 0.2;
};

enum class DriveStatus { kMoving, kTurning, kStopped, kBlocked, kArrived };

/// Why the command is what it is.
enum class DriveReason {
  kOnTheWay,
  kTurnsToPath,
  kAtGoal,
  kFaces,
  kNoPath,
  kGivesWay,     ///< Backs off before a person,
  kBacksOff,     ///< to where a long body can turn, or to a place close behind it.
  kPersonInWay,  ///< A person comes too near to go on.
  kObstacleInWay,
  kBadPose,      ///< Pose or speed isn't finite.
  kBadPath,      ///< A point of the path isn't finite.
  kBadPeople,    ///< A person's motion or size isn't finite.
  kNoClearance,  ///< Nobody knows what is around the robot.
};
const char* describe(DriveStatus status);
const char* describe(DriveReason reason);

/// Whether something else would let a command through.
using Permission = FunctionRef<bool(const VelocityCommand&)>;
inline constexpr auto kAnyCommand = [](const VelocityCommand&) { return true; };

/// What to do until the next period, and why.
struct LocalPlan {
  VelocityCommand command;
  DriveStatus status = DriveStatus::kStopped;
  DriveReason reason = DriveReason::kNoPath;
  DriveScores costs{};        ///< Of the future that was chosen, without weights.
  double gap_m = 0.0;         ///< Room to things that stand, now; may be a lower bound.
  double people_gap_m = 0.0;  ///< Room to the nearest person, now.
  double blocked_s = 0.0;     ///< For how long there has been a way to go but no going.
  std::size_t options = 0;    ///< How many futures were looked at.
};

/// Chooses among futures: the path pursued at several speeds and on either side of it, arcs, turns
/// on the spot, a stop, and backing off: from somebody who comes too near, or where what is left of
/// the path is short enough. A long body that has found no way to go backs off as far as it is
/// long, to where it can turn.
///
/// A future is admissible if the robot, having held its first command for `reacts_s` and then
/// braked, still has its margins to all that stands and to where people can be by then; or if it
/// comes no nearer than it would by standing. Of those the cheapest (see `DriveTerm`) that is
/// permitted is taken. If there is none it brakes. Same calls, same answers.
class LocalPlanner {
 public:
  /// @throws std::invalid_argument  if a limit or a parameter is out of range.
  explicit LocalPlanner(const LocalPlannerParams& params = {});

  /// Decides for one control period; it may be asked more often.
  /// @param speed      What the robot does now.
  /// @param path       From about here to the goal [m, world]; empty if there is nowhere to go.
  /// @param clearance  Distance to what stands; without the people of `people`. Must not allocate.
  /// @param face       What to keep in view, and to turn to when there is no way to go.
  /// @param permits    Asked for commands that are not 0, in no certain order.
  /// @param elapsed_s  Since the step before; absent: a control period.
  LocalPlan step(const FloorPose& pose, const VelocityCommand& speed,
                 const std::vector<Eigen::Vector2d>& path, Clearance clearance,
                 const std::vector<MovingPerson>& people,
                 const std::optional<Eigen::Vector2d>& face = std::nullopt,
                 Permission permits = kAnyCommand, std::optional<double> elapsed_s = std::nullopt);

  /// Where somebody may come out whom nobody sees, from now on [m, world]: it comes towards them
  /// no faster than lets it stand when they reach it, and minds them no further.
  void expect(const std::vector<Eigen::Vector2d>& hidden);

  /// Forgets what went before, but for who is expected.
  void reset();

  const LocalPlannerParams& params() const { return params_; }

 private:
  /// How a first command, held for a while and then braked, ends.
  struct Braking {
    double gap_m;
    double people_gap_m;
    bool admissible;
  };

  std::optional<DriveReason> findFault(const DriveScene& scene,
                                       const std::vector<Eigen::Vector2d>& path) const;
  bool hasArrived(const std::vector<Eigen::Vector2d>& path, const Eigen::Vector2d& position);
  /// Whether somebody walks at the robot, or stands all but at it.
  bool isThreatened(const DriveScene& scene, double room_m) const;
  void layOut(const DriveScene& scene, bool threatened, bool backs);
  Braking brake(const DriveScene& scene, const VelocityCommand& command, Clearance clearance) const;
  std::size_t measure(const DriveScene& scene, std::size_t option, Clearance clearance);
  VelocityCommand slowed(const DriveScene& scene, const VelocityCommand& command,
                         double gap_m) const;
  static double comes(double speed_mps, double walks_mps, double in_s);
  double allowedTowards(const DriveScene& scene, const MovingPerson& person, double walks_mps,
                        const VelocityCommand& command) const;
  void explain(const DriveScene& scene, LocalPlan& plan, bool threatened, double elapsed_s);

  LocalPlannerParams params_;
  std::size_t held_;  // periods for which a command is held
  VelocityCommand last_;
  bool arrived_ = false;
  double blocked_s_ = 0.0;
  double waited_s_ = 0.0;  // since it last drove, with a way to go
  double backs_s_ = 0.0;   // so long a long body still backs off
  double gap_m_ = 0.0;
  std::vector<MovingPerson> hidden_;
  PathAhead path_;
  Trajectories futures_;
  std::vector<double> gaps_m_;         // Of the future at hand, per step.
  std::vector<double> staying_gap_m_;  // Least room to people's ways when standing, per step.
};

}  // namespace heel
