// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How tall somebody is: what tells people apart who wear the same.
#pragma once

#include <optional>
#include <vector>

namespace heel {

/// Of a person, learned over many frames.
struct Stature {
  double height_m = 0.0;  ///< Median of what single frames show.
  double spread_m = 0.0;  ///< Their standard deviation (of the middle half, so robust).
  int frames = 0;         ///< On how many it rests.
};

/// What a single frame shows of somebody's height.
///
/// Not the highest point, which noise lifts, but a height that 2 % of the points of the upper body
/// are above. Nothing without enough points of the upper body, or if the head may be out of view:
/// they reach the picture's upper edge or a side, or too little behind them is seen above them,
/// because a door's frame cuts them off.
class StatureSample {
 public:
  static constexpr double kLeastHeight_m = 1.2;  ///< What is lower is not looked at.
  static constexpr double kMostHeight_m = 2.3;   ///< Nor what is higher, by who adds points.
  static constexpr int kEdge_px = 8;             ///< Stereo has no depth in the outermost few.
  static constexpr int kMinPoints = 60;
  static constexpr double kAbove_m = 0.1;  ///< So far above them is looked at what is behind.

  void clear();
  /// @param at_edge  Whether it is at the picture's upper edge or one of its sides.
  void add(double height_m, bool at_edge = false);
  /// A point behind them, or with no depth for it is too far, seen at this height of theirs.
  void addBehind(double height_m);
  /// @param full  So many points behind a body were seen if all above it were, up to kAbove_m; 0:
  ///              those were not counted.
  std::optional<double> height_m(double full = 0.0);

 private:
  std::vector<double> heights_m_, behind_m_;
  bool cut_off_ = false;
};

/// Nothing from fewer than five frames.
std::optional<Stature> statureFrom(std::vector<double> heights_m);

}  // namespace heel
