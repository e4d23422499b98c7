// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Looking at people who may be the one who is lost.
#pragma once

#include <heel/apps/follower/behaviours.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace heel {

/// Looks at whoever may be the person who is lost, from where all of them is in view, as long as
/// that is likelier to find them than a second spent elsewhere. The more looks at a place
/// were in vain, the more it is expected to take, whoever comes and goes there.
class LookWhoThatIs : public Behaviour {
 public:
  LookWhoThatIs(const Premises& premises, const FollowerParams& params);

  /// To be told of each step.
  void watch(const Situation& now);
  /// Whether somebody is worth a look.
  bool wants() const { return choice_.has_value(); }
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;

 private:
  struct Effort {
    Eigen::Vector2d place;
    bool is_whole = false;  ///< From where all of somebody there is in view,
    double looks = 0.0;     ///< so many.
  };
  struct Choice {
    Eigen::Vector2d place;
    bool is_whole = false;  ///< From where all of somebody there is in view,
    bool goes = false;      ///< to where it goes first.
    double takes_s = 0.0;   ///< With the turn and the way,
    double per_s = 0.0;     ///< and how likely it finds the person, a second.
  };

  Choice rated(const Suspect& suspect, const Situation& now) const;
  /// Index of the effort there; their number if there is none.
  std::size_t find(const Eigen::Vector2d& place, bool is_whole) const;

  DriveLimits drive_;
  double look_s_, near_m_, far_m_;
  FollowTarget whole_;
  std::optional<Choice> choice_;
  std::vector<Effort> efforts_;  // since the person was lost
};

}  // namespace heel
