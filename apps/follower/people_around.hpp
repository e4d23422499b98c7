// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who is around the robot, as far as it knows.
#pragma once

#include <heel/apps/follower/behaviour.hpp>
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/unseen_people.hpp>
#include <heel/planning/recent_sight.hpp>
#include <heel/tracking/kalman.hpp>

#include <vector>

namespace heel {

/// Tracks that are people, whoever came lately to where the laser had seen nothing, and, for a
/// while, those who were seen before.
class PeopleAround {
 public:
  explicit PeopleAround(const FollowerParams& params);

  /// @param stamp_s  On a clock that does not jump.
  /// @param sight    What the laser and the camera saw, in a frame that does not jump;
  /// @param T_frame_world  it is this one.
  /// @param now  In: where the robot is, and the target. Out: its people.
  void step(double stamp_s, const Perception& perception, const RecentSight& sight,
            const FloorPose& T_frame_world, Situation& now);

  /// Whether somebody who is known of is at a place.
  bool isAnybodyAt(const Eigen::Vector2d& place, const Situation& now) const;
  /// Whether somebody but the target is seen there now.
  bool isSeenAt(const Eigen::Vector2d& place, const Situation& now) const;

  /// Those who rest, but for the target, with the room beside them: paths lead another way.
  const std::vector<MovingPerson>& resting() const { return unseen_.resting(); }
  /// Around all of them, in a frame [m]; valid until the next call.
  const std::vector<FloorDisc>& discs(const std::vector<MovingPerson>& people,
                                      const FloorPose& T_frame_world);

 private:
  void addTracks(double stamp_s, const Perception& perception, Situation& now) const;
  void addComers(const RecentSight& sight, const FloorPose& T_world_frame, Situation& now) const;
  bool isNear(const Eigen::Vector2d& place, const std::optional<MovingPerson>& person) const;

  double avoid_above_, walks_on_s_, person_m_, known_within_m_;
  UnseenPeople unseen_;
  std::vector<FloorDisc> discs_;
};

/// Standard deviation of somebody's velocity along the line to a place [m/s].
double gaitOf(const MotionState& motion, const Eigen::Vector2d& place);

}  // namespace heel
