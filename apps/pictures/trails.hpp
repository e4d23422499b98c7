// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where tracks have been, for the pictures.
#pragma once

#include <Eigen/Core>

#include <map>
#include <vector>

namespace heel {

/// Remembers the last places of every track; the memory follows the number of tracks that are
/// alive, not the length of the recording.
class Trails {
 public:
  /// @param duration_s  How long a place is remembered.
  explicit Trails(double duration_s = 4.0) : duration_s_(duration_s) {}

  /// Adds where a track is now.
  void add(int track_id, double stamp_s, const Eigen::Vector2d& position_m);

  /// Forgets what is older than the duration, and tracks of which nothing is left.
  void forget(double now_s);

  /// The places of a track, the oldest first.
  std::vector<Eigen::Vector2d> of(int track_id) const;

 private:
  struct Place {
    double stamp_s;
    Eigen::Vector2d position_m;
  };

  double duration_s_;
  std::map<int, std::vector<Place>> places_;
};

}  // namespace heel
