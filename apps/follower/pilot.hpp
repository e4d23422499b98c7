// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// From an intent to a velocity: along a path, touching nothing.
#pragma once

#include <heel/apps/follower/behaviour.hpp>
#include <heel/planning/clearance_map.hpp>
#include <heel/planning/global_planner.hpp>
#include <heel/planning/local_planner.hpp>

#include <optional>
#include <vector>

namespace heel {

/// What the pilot makes of an intent.
struct PilotStep {
  VelocityCommand velocity;
  IntentOutcome outcome;
  std::optional<Eigen::Vector2d> goal;  ///< Where it goes, if anywhere;
  const FloorPath* path = nullptr;      ///< the way there, valid until the next plan.
  const char* reason = "";              ///< In a few words, or empty.
};

/// Plans a way around what the map and the moment show, and drives along it.
class Pilot {
 public:
  /// @param give_up_s  Who was blocked for so long goes another way, or is as near as can be; so is
  ///                   who has not left its place for as long and a full turn.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  Pilot(const OccupancyGrid& floor, const GlobalPlannerParams& paths,
        const LocalPlannerParams& drive, double give_up_s);

  /// What stands around the robot; it must outlive the steps until the next call.
  /// @param stood_s  For how long each of the things has, as ObstacleLayer::stood_s().
  /// @param people   Who rests.
  void setAround(const OccupancyGrid& things, const std::vector<float>& stood_s,
                 const std::vector<MovingPerson>& people);
  /// Where somebody may come out whom nobody sees.
  void expect(const std::vector<Eigen::Vector2d>& hidden) { local_planner_.expect(hidden); }
  /// Forgets how it drove before.
  void reset();

  /// Distance to things, as LocalPlanner takes it,
  double room_m(const Eigen::Vector2d& place) const { return room_.clearance(place); }
  /// and to things and people who stand.
  double free_m(const Eigen::Vector2d& place) const {
    return planner_.clearance().clearance(place);
  }
  /// The way from one place to another around all that stands; valid until the next plan
  /// or step.
  const GlobalPlan& plan(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  /// How long it takes from a pose to a place around what stands, or waiting for it to go,
  /// whichever is sooner; infinite where no way leads.
  double takes_s(const FloorPose& from, const Eigen::Vector2d& to);

  /// @param people     Who walks and who stands.
  /// @param sensed     Distance to what the sensors have seen of late.
  /// @param permits    As LocalPlanner's.
  /// @param elapsed_s  Since the step before.
  PilotStep step(const Intent& intent, const DriveState& robot,
                 const std::vector<MovingPerson>& people, Clearance sensed, Permission permits,
                 double elapsed_s);

 private:
  /// Where it was when it was as near to a goal as can be.
  struct Arrival {
    Eigen::Vector2d goal, place;
  };

  bool findWay(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  double barred_m(const FloorPath& path);
  bool canTurnTo(const Eigen::Vector2d& place, const DriveState& robot, Clearance room) const;
  Eigen::Vector2d turningPlace(const FloorPose& pose, Clearance room) const;

  double give_up_s_;
  ClearanceMap room_;  // to things
  GlobalPlanner planner_;
  GlobalPlanner on_map_;  // with nothing else
  LocalPlanner local_planner_;
  const OccupancyGrid* things_ = nullptr;
  const std::vector<float>* stood_s_ = nullptr;
  const std::vector<MovingPerson>* resting_ = nullptr;
  std::vector<FloorDisc> discs_;  // of these
  GlobalPlan plan_, through_;
  PathAhead barred_;
  bool is_through_ = false;                  // The way leads through what stands there now.
  std::optional<Eigen::Vector2d> round_to_;  // It has waited before that: round to here.
  std::optional<Arrival> arrival_;
  Eigen::Vector2d stays_at_ = Eigen::Vector2d::Zero();
  double stays_s_ = 0.0;
};

}  // namespace heel
