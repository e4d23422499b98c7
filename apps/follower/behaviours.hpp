// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the plan's actions do, each by itself (section 3.3 of the paper).
#pragma once

#include <heel/apps/follower/behaviour.hpp>
#include <heel/apps/follower/follower_params.hpp>
#include <heel/mapping/wall_map.hpp>
#include <heel/planning/doorways.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace heel {

/// What does not move. The behaviours share one; it must outlive them.
struct Premises {
  std::shared_ptr<const WallMap> walls;  ///< Null: nothing hides anybody.
  std::vector<DoorwayOnMap> doorways;
  double passage_depth_m = 0.0;  ///< The robot is in a doorway's way so far before and behind it,
  double radius_m = 0.0;         ///< as far as its edge goes.
  double eye_m = 0.0;            ///< Height of the camera.

  /// @param doorways  Of the floor.
  Premises(const FollowerParams& params, std::shared_ptr<const WallMap> walls,
           std::vector<DoorwayOnMap> doorways);

  bool isInDoorway(const Eigen::Vector2d& place) const {
    return isInPassage(doorways, place, passage_depth_m, radius_m);
  }
  /// Whether a place has both sides of a person in view, as far as the map knows.
  bool sees(const Eigen::Vector2d& from, const Eigen::Vector2d& person) const;
};

/// Goes where it is with the person: near, in view and in nobody's way.
class FollowTarget : public Behaviour {
 public:
  FollowTarget(const Premises& premises, const GoalChooserParams& params)
      : premises_(premises), places_(params) {}

  void begin(const Situation&) override { places_.reset(); }
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;

  /// The place to be with somebody, if there is one.
  std::optional<Eigen::Vector2d> placeBy(const MovingPerson& person, const Situation& now,
                                         const Ways& ways);

 private:
  const Premises& premises_;
  GoalChooser places_;
};

/// Stands and turns to the person; leaves a doorway first, for nobody waits where it stands in one.
class FaceTarget : public Behaviour {
 public:
  FaceTarget(const Premises& premises, const FollowerParams& params)
      : premises_(premises), beside_m_(params.beside_m), aside_(premises, params.goal) {}

  void begin(const Situation& now) override { aside_.begin(now); }
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;

 private:
  const Premises& premises_;
  double beside_m_;
  FollowTarget aside_;
};

/// Goes to where the person was seen last.
class GoToLastSeen : public Behaviour {
 public:
  /// @param near_m  From so far off somebody who stood there would be seen: no need to go on.
  explicit GoToLastSeen(double near_m) : near_m_(near_m) {}

  std::optional<Intent> step(const Situation& now, const Ways& ways) override;

 private:
  double near_m_;
};

/// Turns on the spot, towards the side where the person was last seen.
class SeekTarget : public Behaviour {
 public:
  SeekTarget(double most_turn_radps, double walks_on_s)
      : most_turn_radps_(most_turn_radps), walks_on_s_(walks_on_s) {}

  void begin(const Situation& now) override;
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;
  void tell(FollowingFacts& facts) const override;

 private:
  double most_turn_radps_;
  double walks_on_s_;
  double turned_rad_ = 0.0;
  double side_ = 1.0;  // +1: to the left
};

/// Goes where the chance to see the person is best, and looks there.
class SearchForTarget : public Behaviour {
 public:
  /// @param search  Must outlive this. Null: there is no map, and it waits.
  explicit SearchForTarget(PersonSearch* search) : search_(search) {}

  void begin(const Situation& now) override;
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;
  void note(const IntentOutcome& outcome) override;
  void tell(FollowingFacts& facts) const override;

 private:
  PersonSearch* search_;
  bool is_there_ = false;  // at the view, and turned to it
};

}  // namespace heel
