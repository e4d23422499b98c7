// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A run of following on the map, as the paper's Figure 4 shows it, and its moments to point at.
#pragma once

#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <string>

namespace heel {

/// The frame of a map's drawing: metres from its upper left corner, y down.
class MapFrame {
 public:
  /// The walls and the ways of the robot and the person, with a small margin.
  explicit MapFrame(const FollowLog& log);

  Eigen::Vector2d topLeft() const { return {bounds_.min().x(), bounds_.max().y()}; }
  Eigen::Vector2d size() const { return bounds_.sizes(); }
  /// Size of marks for one on a map of 10 m.
  double markScale() const { return std::clamp(size().maxCoeff() / 10.0, 0.5, 8.0); }
  Eigen::Vector2d operator()(const Eigen::Vector2d& place_m) const {
    return {place_m.x() - bounds_.min().x(), bounds_.max().y() - place_m.y()};
  }

 private:
  Eigen::AlignedBox2d bounds_;
};

/// Walls, the robot's path, the person's path, both joined at even times, where the target was
/// lost and found, and the marks that the page's script moves to one moment: SVG.
std::string followMap(const FollowLog& log, const MapFrame& frame);

/// What the marks of followMap() mean: list items.
std::string followMapLegend(const FollowLog& log);

struct FollowMoments {
  std::size_t count = 0;
  std::string json;  ///< May stand in a script element; follow.js says what is in it.
};

/// @param most  Longer runs are thinned out evenly to about as many.
FollowMoments followMoments(const FollowLog& log, const MapFrame& frame, StateTones& tones,
                            std::size_t most);

}  // namespace heel
