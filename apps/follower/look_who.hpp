// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Looking at people who may be the one who is lost.
#pragma once

#include <heel/apps/follower/behaviours.hpp>
#include <heel/tracking/identity.hpp>

#include <optional>
#include <vector>

namespace heel {

/// Looks at whoever may be the person who is lost, from where all of them is in view, as long as
/// that is likelier to find them than a second spent elsewhere. Another look at somebody is worth
/// what is new in it.
class LookWhoThatIs : public Behaviour {
 public:
  LookWhoThatIs(const Premises& premises, const FollowerParams& params);

  /// To be told of each step.
  void watch(const Situation& now);
  /// Whether somebody is worth a look.
  bool wants() const { return choice_.has_value(); }
  std::optional<Intent> step(const Situation& now, const Ways& ways) override;
  void note(const IntentOutcome& outcome) override;

 private:
  struct Look {
    Eigen::Vector2d place, ray_m;  ///< Of whom, and that from the robot,
    double stamp_s = 0.0;          ///< on the clock.
  };
  struct Choice {
    Eigen::Vector2d place, ray_m;  ///< Of whom, and along which it will look.
    bool is_ahead = false;
    bool goes = false;   ///< To another distance first.
    double per_s = 0.0;  ///< How likely it finds the person, a second.
  };

  Choice rated(const Suspect& suspect, const Situation& now) const;
  double newsOf(const Eigen::Vector2d& place, const Eigen::Vector2d& ray_m) const;
  void remember(const Eigen::Vector2d& place, const Eigen::Vector2d& ray_m);
  bool isOfChoice(const Eigen::Vector2d& place) const;

  IdentityParams looking_;
  DriveLimits drive_;
  double look_s_, ahead_rad_, near_m_, far_m_;
  FollowTarget nearer_;
  std::optional<Choice> choice_;
  bool is_near_ = false;     // to that, as near as it can get,
  bool has_turned_ = false;  // and to it, as far as it can,
  double looked_s_ = 0.0;    // and has looked.
  std::vector<Look> looks_;  // since the person was lost, the last ones
  double clock_s_ = 0.0;
};

}  // namespace heel
