// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Something that the robot can do: a belief in, an intent out.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/following_plan.hpp>
#include <heel/planning/global_planner.hpp>
#include <heel/planning/surroundings.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace heel {

/// Somebody who may be the person who is lost.
struct Suspect {
  Eigen::Vector2d place;
  double probability = 0.0;  ///< That it is they.
};

/// All that a behaviour goes by; places are on the map [m, world].
struct Situation {
  double elapsed_s = 0.0;   ///< Since the step before;
  double turned_rad = 0.0;  ///< the robot has turned so far, by odometry.
  FloorPose robot;
  std::optional<MovingPerson> target;     ///< Whom it follows, where they are known to be.
  MovingPerson last;                      ///< They, when they were seen last,
  double unseen_s = 0.0;                  ///< so long ago.
  std::vector<Suspect> suspects;          ///< Who may be they, while they are lost,
  double elsewhere_per_s = 0.0;           ///< and how likely they are found elsewhere, a second.
  std::vector<MovingPerson> people;       ///< Everybody who is known of, the target last.
  std::size_t seen_people = 0;            ///< The first ones, who are seen, and not the target.
  std::optional<Eigen::Vector2d> way_to;  ///< The end of the way on which it is.

  /// Where they are if they walked on, but for no longer than this.
  MovingPerson expected(double walks_on_s) const;
};

/// What a behaviour can ask of the floor. No allocation once warm.
struct Ways {
  Clearance room;  ///< To things.
  Clearance free;  ///< To things, and to people who stand.
  /// The way from one place to another; valid until the next question.
  FunctionRef<const GlobalPlan&(const Eigen::Vector2d&, const Eigen::Vector2d&)> plan;
  /// How long it takes from a pose to a place; infinite where no way leads.
  FunctionRef<double(const FloorPose&, const Eigen::Vector2d&)> takes_s;
};

/// What the robot is to do until the next step. Without any of it, it stands.
struct Intent {
  std::optional<Eigen::Vector2d> go_to;  ///< [m, world]
  double near_enough_m = 0.0;            ///< It has arrived when it is nearer than this.
  /// To turn to where there is nowhere to go, or once there.
  std::optional<Eigen::Vector2d> look_at;
  std::optional<Eigen::Vector2d> keep_in_view;  ///< On the way.
  /// It goes to another place than before: what barred that way is forgotten.
  bool is_new = false;
  double most_turn_radps = std::numeric_limits<double>::infinity();  ///< While it looks.
  const char* reason = "";                                           ///< In a few words, or empty.
};

/// What came of an intent.
struct IntentOutcome {
  bool has_arrived = false;  ///< Where it was to go, or as near as can be.
  bool has_looked = false;   ///< It stands, turned to what it was to look at.
};

/// One thing that the robot can do. To have it do that in another way, write another one, and give
/// it to Follower::exchange().
class Behaviour {
 public:
  Behaviour() = default;
  Behaviour(const Behaviour&) = delete;
  Behaviour& operator=(const Behaviour&) = delete;
  virtual ~Behaviour() = default;

  /// It is this behaviour's turn, which was another's.
  virtual void begin(const Situation&) {}
  /// What to do; nothing where there is no need, and another behaviour is asked.
  virtual std::optional<Intent> step(const Situation& now, const Ways& ways) = 0;
  /// What came of the last intent.
  virtual void note(const IntentOutcome&) {}
  /// Tells the plan what only it knows: kFullTurn and kSearchOver.
  virtual void tell(FollowingFacts&) const {}
};

}  // namespace heel
