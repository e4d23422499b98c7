// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Makes a path short by pulling it taut around what is in its way, as a string.
#pragma once

#include <heel/planning/clearance_map.hpp>
#include <heel/planning/path.hpp>

namespace heel {

/// Pulls paths taut for a round body; keeps its memory from path to path.
class TautPath {
 public:
  /// @param map  Must outlive this.
  TautPath(const ClearanceMap& map, double radius_m) : map_(&map), radius_m_(radius_m) {}

  /// Shortens a path whose pieces are clear; they stay so, exactly. Bends become a few points on
  /// the tangents of the curve that the string would follow.
  void pull(FloorPath& path);

  /// Moves bends further from what they go around, by up to `room_m`, where there is such room; the
  /// pieces stay clear. A robot that does not keep exactly to its path has this to spare.
  void widen(FloorPath& path, double room_m);

 private:
  bool isClear(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    return map_->isClear(a, b, radius_m_);
  }
  void skipAhead(FloorPath& path);
  void slide(FloorPath& path);
  void cutBends(FloorPath& path);
  Eigen::Vector2d awayFrom(const Eigen::Vector2d& place) const;
  /// How much of the way from `from` to `to` can be gone so that `eye` still sees the place.
  double seenShare(const Eigen::Vector2d& eye, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to) const;

  const ClearanceMap* map_;
  double radius_m_;
  FloorPath next_;
};

}  // namespace heel
