// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the maps of pages are drawn with: SVG in metres.
#pragma once

#include <heel/apps/pages/run_moments.hpp>
#include <heel/apps/results/follow_log.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <string>

namespace heel {

/// The largest of 1, 2 and 5 times a power of ten that parts `range` into at most `parts` steps or
/// few more.
double niceStep(double range, double parts);

/// The frame of a map's drawing: metres from its upper left corner, y down.
class MapFrame {
 public:
  /// With a small margin around the bounds, which may be empty.
  explicit MapFrame(const Eigen::AlignedBox2d& bounds_m);

  Eigen::Vector2d topLeft() const { return {bounds_.min().x(), bounds_.max().y()}; }
  Eigen::Vector2d size() const { return bounds_.sizes(); }
  /// Size of marks for one on a map of 10 m.
  double markScale() const { return std::clamp(size().maxCoeff() / 10.0, 0.5, 8.0); }
  /// Metres between the lines of its lattice.
  double step_m() const { return niceStep(size().maxCoeff(), 12); }
  Eigen::Vector2d operator()(const Eigen::Vector2d& place_m) const {
    return {place_m.x() - bounds_.min().x(), bounds_.max().y() - place_m.y()};
  }

 private:
  Eigen::AlignedBox2d bounds_;
};

/// "x y" of a place of the drawing.
std::string svgPlace(const Eigen::Vector2d& at);

/// A path of the class; nothing for an empty one.
std::string svgShape(const std::string& of_class, const std::string& path);

/// A square of this half width: a path.
std::string svgSquare(const Eigen::Vector2d& at, double half);

/// The beginning of the map: `what` is its description for those who do not see it.
std::string svgMap(const MapFrame& frame, const std::string& what);

/// What nobody knows of the map, and its walls; nothing of an empty one.
std::string svgWalls(const OccupancyGrid& map, const MapFrame& frame);

/// An item of a map's legend: SVG of 26 by 14, and HTML.
std::string legendItem(const std::string& drawing, const std::string& text);
/// The same for a line of this tone.
std::string legendLine(const std::string& tone, const std::string& dashes, const std::string& text);

/// The walls and the ways of the robot and the person.
MapFrame followFrame(const FollowLog& log);

/// Walls, the robot's path, the person's path, both joined at even times, where the target was
/// lost and found, and the marks that the page's script moves to one moment: SVG.
std::string followMap(const FollowLog& log, const MapFrame& frame);

/// What the marks of followMap() mean: list items.
std::string followMapLegend(const FollowLog& log);

/// Where followMap()'s marks are at each moment.
void addFollowMarks(const FollowLog& log, const MapFrame& frame, RunMoments& moments);

}  // namespace heel
