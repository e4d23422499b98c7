// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the robot was when a reading was measured that came late.
#pragma once

#include <heel/mapping/floor_pose.hpp>

#include <array>
#include <cstddef>

namespace heel {

/// The last few seconds of the odometry, in a frame that does not jump: that of the first pose.
class MotionHistory {
 public:
  /// @param moved  Since the pose before, in its frame. One that is not later is added to that.
  void add(double stamp_s, const FloorPose& moved);

  /// The newest pose; the frame's origin before the first.
  const FloorPose& pose() const { return places_[newest_].pose; }
  double stamp_s() const { return places_[newest_].stamp_s; }

  /// The pose at a time: between two poses, or a little beyond the newest, at an even speed; the
  /// oldest before that.
  FloorPose at(double stamp_s) const;

  /// The base frame at a time, as seen from the newest base frame.
  FloorPose seenFromNow(double stamp_s) const {
    return stamp_s == this->stamp_s() ? FloorPose{} : pose().inverse() * at(stamp_s);
  }

 private:
  struct Place {
    double stamp_s = 0.0;
    FloorPose pose;
  };
  const Place& back(std::size_t steps) const {
    return places_[(newest_ + places_.size() - steps) % places_.size()];
  }

  std::array<Place, 64> places_;  // a ring
  std::size_t newest_ = 0;
  std::size_t count_ = 1;
};

}  // namespace heel
