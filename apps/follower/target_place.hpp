// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the target is. The camera knows who they are; the laser sees further to the sides.
#pragma once

#include "apps/follower/attention.hpp"
#include "apps/follower/people_around.hpp"
#include "planning/function_ref.hpp"
#include "planning/surroundings.hpp"
#include "tracking/target.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace heel {

struct TargetPlaceParams {
  double legs_within_m = 0.4;  ///< Legs this near to the target are the target's.
  double max_speed_mps = 1.0;  ///< Nobody walks away from the robot any faster.
  double walks_on_s = 2.0;     ///< Who was lost is expected to walk on for so long.
  // Without the camera, legs are doubted more and more, until they are taken for anybody's.
  double legs_alone_s = 12.0;   ///< Where only the laser sees, they are believed for so long,
  double legs_in_view_s = 2.0;  ///< where the camera should see the person, for so long,
  double legs_mixed_s = 1.5;    ///< for so long where another thing stands beside them,
  double legs_unlike_s = 0.4;   ///< and for so long where the camera sees somebody else.
  double legs_apart_m = 0.6;    ///< That is, nearer than this.
  /// Who is the target with this probability surely is: their legs are believed, and all others are
  /// others.
  double sure = 0.9;
  // A suspect is looked at once; who is not recognized then is somebody else.
  double look_s = 1.0;            ///< So long before the camera,
  double turn_to_s = 3.0;         ///< or so long in vain until they are.
  double weak_look_doubt = 0.75;  ///< What a weaker look leaves: 1 is not to believe the legs.
};

/// Holds on to one person's place with both sensors. Whoever the camera sees as the target lends
/// their identity to the legs that the laser sees there; out of the camera's view, the legs carry
/// it on until they are doubted too much.
class TargetPlace {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit TargetPlace(const TargetPlaceParams& params = {});

  /// They are known to be here (after phase 1, say).
  void startAt(const Eigen::Vector2d& position_m) { last_.position = position_m; }

  /// @param seen        What the camera's tracker says now.
  /// @param around      What the laser sees now.
  /// @param is_in_view  Whether the camera sees a person at a place if there is one.
  /// @param is_unlike   Whether the camera sees somebody else at a place.
  void step(const TargetEstimate& seen, const PeopleAround& around,
            FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
            FunctionRef<bool(const Eigen::Vector2d&)> is_unlike, double elapsed_s);

  /// Where they are; nothing where no sensor tells.
  const std::optional<MovingPerson>& now() const { return now_; }
  /// Whether nobody else can be taken for them: no thing was beside these legs since the camera saw
  /// whose they are.
  bool isSure() const { return now_ && !mixed_; }
  /// Where others are: who the laser saw apart from the target while the camera saw the target, and
  /// has not lost since.
  const std::vector<Eigen::Vector2d>& others() const { return others_m_; }
  /// Where they were when last seen.
  const MovingPerson& last() const { return last_; }
  /// Who walks where they can be by now, and has not been looked at since they were lost; nothing
  /// while they are known.
  const std::optional<MovingPerson>& suspect() const { return suspect_; }
  /// Where to look for them first: at the suspect, or where they are if they walked on.
  MovingPerson expected() const;
  /// Time since then.
  double unseen_s() const { return unseen_s_; }

 private:
  const Track* believedLegs(const PeopleAround& around,
                            FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
                            FunctionRef<bool(const Eigen::Vector2d&)> is_unlike, double elapsed_s);
  bool isSureLook(const TargetEstimate& seen) const {
    return seen.status == TargetStatus::kFollowed && seen.confidence > params_.sure;
  }
  void noteOthers(const PeopleAround& around, bool is_sure);
  void findSuspect(const PeopleAround& around, FunctionRef<bool(const Eigen::Vector2d&)> is_in_view,
                   double elapsed_s);

  TargetPlaceParams params_;
  std::optional<MovingPerson> now_;
  std::optional<MovingPerson> suspect_;
  MovingPerson last_;
  double unseen_s_ = 0.0;
  int legs_ = 0;             // the target's, among the people around
  std::vector<int> others_;  // things around that are not the target
  std::vector<Eigen::Vector2d> others_m_;
  Attention attention_;  // to suspects, since the loss
  bool mixed_ = false;
  double doubt_ =
      0.0;  // of these legs: 0 when the camera sees whose they are, none believed from 1
};

}  // namespace heel
