// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/motion_history.hpp>

#include <algorithm>

namespace heel {

void MotionHistory::add(double stamp_s, const FloorPose& moved) {
  const FloorPose now = pose() * moved;
  if (count_ > 1 && stamp_s <= places_[newest_].stamp_s) {
    places_[newest_].pose = now;
    return;
  }
  newest_ = (newest_ + 1) % places_.size();
  places_[newest_] = {stamp_s, now};
  count_ = std::min(count_ + 1, places_.size());
}

FloorPose MotionHistory::at(double stamp_s) const {
  if (count_ < 3) return pose();  // the origin has no time
  std::size_t steps = 1;
  while (steps + 2 < count_ && back(steps).stamp_s > stamp_s) ++steps;
  const Place &from = back(steps), &to = back(steps - 1);
  constexpr double kBeyond = 3.0;  // of the time between two readings
  const double share =
      std::clamp((stamp_s - from.stamp_s) / (to.stamp_s - from.stamp_s), 0.0, kBeyond);
  const FloorPose motion = from.pose.inverse() * to.pose;
  return from.pose * FloorPose{share * motion.position, share * motion.yaw_rad};
}

}  // namespace heel
