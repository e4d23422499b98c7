// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where there is no room for two, the robot leaves the way to a person.
#pragma once

#include <heel/apps/follower/behaviours.hpp>

#include <optional>
#include <vector>

namespace heel {

/// Goes aside for the target who comes up to it, and for anybody while the robot gets nowhere;
/// waits there until they have gone from where it stood in their way.
class MakeRoom : public Behaviour {
 public:
  MakeRoom(const Premises& premises, const FollowerParams& params)
      : premises_(premises), params_(params) {}

  /// To be told of each step: who wants to go somewhere, and turns this way and that, is stuck.
  void watch(const Situation& now);

  std::optional<Intent> step(const Situation& now, const Ways& ways) override;
  void note(const IntentOutcome& outcome) override;

 private:
  struct Aside {
    Eigen::Vector2d place;   // where it goes
    Eigen::Vector2d before;  // where it was then
    bool is_for_target = false;
    double since_s = 0.0;
    double waited_s = 0.0;
  };

  const MovingPerson* whoWantsPast(const Situation& now, const Ways& ways);
  bool isInTheWayOf(const MovingPerson& person, const Situation& now, const Ways& ways) const;
  bool goAside(const MovingPerson& person, const Situation& now, const Ways& ways);

  const Premises& premises_;
  FollowerParams params_;
  double elapsed_s_ = 0.0;
  Eigen::Vector2d stood_at_ = Eigen::Vector2d::Zero();  // and has not left since,
  double stuck_s_ = 0.0;                                // though it wanted to for so long
  std::optional<Aside> aside_;
  std::vector<Eigen::Vector2d> near_, places_;
};

}  // namespace heel
