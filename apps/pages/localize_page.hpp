// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where a robot was on its map, as one HTML page that needs nothing else.
#pragma once

#include <heel/apps/pages/run_page.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// One localized scan, in the map's frame.
struct LocalizedMoment {
  double stamp_s = 0.0;
  FloorPose estimate;
  double std_m = kNotKnown;  ///< Standard deviation of its place.
  double fit = kNotKnown;    ///< Share of the beams that fit the map.
  std::string state;         ///< "found" or "lost".
  std::optional<FloorPose> reference;
};

/// A whole log, and its figures; NaN stands for what is not known.
struct LocalizedLog {
  std::string name;
  bool complete = true;
  double way_m = kNotKnown;
  double lost_share = kNotKnown;
  double rms_m = kNotKnown;  ///< Against the reference, as the others.
  double rms_deg = kNotKnown;
  double median_m = kNotKnown;
  double worst_m = kNotKnown;
  std::vector<LocalizedMoment> moments;
};

/// The whole page, well-formed as XML too; the same log gives the same bytes.
std::string localizePage(const LocalizedLog& log, const OccupancyGrid& map);

}  // namespace heel
