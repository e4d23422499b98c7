// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A run of following on the map, as the paper's Figure 4 shows it.
#pragma once

#include <heel/apps/results/follow_log.hpp>

#include <Eigen/Geometry>

#include <algorithm>
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

}  // namespace heel
