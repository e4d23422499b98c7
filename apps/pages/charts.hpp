// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Curves over time and histograms, in the style of Heel's pages.
#pragma once

#include <heel/apps/results/follow_log.hpp>

#include <functional>
#include <string>
#include <vector>

namespace heel {

/// The largest of 1, 2 and 5 times a power of ten that parts `range` into at most `parts` steps or
/// few more.
double niceStep(double range, double parts);

/// The time that a run's charts show.
struct TimeScale {
  explicit TimeScale(const std::vector<FollowSample>& samples);
  double share(double stamp_s) const { return (stamp_s - first_s) / duration_s; }
  double first_s = 0.0;
  double duration_s = 1.0;  ///< Above 0.
};

/// One chart of the timeline.
struct ChartParams {
  std::string title;
  std::string unit;
  std::string style;         ///< "robot", "person" or "clear".
  double least_top = 1;      ///< The scale reaches from 0 up to this at least,
  double most_top = 1e9;     ///< and at most up to this.
  double limit = kNotKnown;  ///< A line at this value, with what it means:
  std::string limit_text;
  bool limit_is_bad = false;
};

/// What lies behind the curves of all charts: the times without a target, tinted. SVG.
std::string lostTimes(const std::vector<FollowSample>& samples, const TimeScale& scale);

/// A curve of one value over time, with its scale: HTML around SVG. Values that are not finite
/// break the curve.
std::string timeChart(const std::vector<FollowSample>& samples, const TimeScale& scale,
                      const std::function<double(const FollowSample&)>& value,
                      const ChartParams& params, const std::string& behind = {});

/// Marks of time under the charts.
std::string timeTicks(const TimeScale& scale);

/// How many values fall in each of `bins` ranges of width `step` from `first` on; values that are
/// not finite are left out, those at the upper end belong to the last range.
std::vector<int> binned(const std::vector<double>& values, double first, double step, int bins);

/// A figure with bars, the middle value and the extremes: HTML around SVG.
std::string histogram(const std::string& title, const std::string& unit,
                      const std::vector<double>& values);

}  // namespace heel
