// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The CLEAR MOT metrics of multiple object tracking (Bernardin and Stiefelhagen 2008).
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace heel {

/// Somebody's place in a frame: a true one, or an estimated one.
struct LabelledPlace {
  int id = 0;  ///< Of the person or the track; detections without identity get distinct numbers.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

/// Everyone who is there in a frame, and everyone who was reported. Ids are unique in each list.
struct TrackingFrame {
  std::vector<LabelledPlace> truth;
  std::vector<LabelledPlace> estimates;
};

/// What counts as a match.
struct ClearMotParams {
  double match_distance_m = 0.5;  ///< An estimate further than this from a person is not of them.
  /// Whether last frame's pairs are kept while they are near enough, and switches counted. Off for
  /// detectors, whose results have no identity: each frame is then matched anew.
  bool has_identity = true;
};

/// The counts, summed over all frames, and the figures that follow from them.
struct ClearMot {
  int frames = 0;
  int truths = 0;           ///< g: people there.
  int matches = 0;          ///< c.
  int misses = 0;           ///< m: people there without an estimate.
  int false_positives = 0;  ///< fp: estimates of nobody.
  int mismatches = 0;       ///< mme: a person's estimate has another id than their last one had.
  double distance_sum_m = 0.0;  ///< Over the matches.

  double recall() const { return share(matches, truths); }
  double precision() const { return share(matches, matches + false_positives); }
  /// 1 - (m + fp + mme) / g.
  double mota() const { return 1.0 - share(misses + false_positives + mismatches, truths); }
  /// 1 - (m + fp) / g: the detector's part of MOTA.
  double moda() const { return 1.0 - share(misses + false_positives, truths); }
  /// Mean distance of the matches [m].
  double motp_m() const { return matches == 0 ? kNothing : distance_sum_m / matches; }

 private:
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  static double share(int part, int whole) {
    return whole == 0 ? kNothing : static_cast<double>(part) / whole;
  }
};

/// Counts over `frames`, in order. In each, the pairs of the frame before are kept where they are
/// still within the matching distance; the rest is matched so that most pairs are made, at the
/// least sum of distances. A person's last id is remembered while they are away or missed.
/// Figures without anything to divide by are NaN.
/// @throws std::invalid_argument  if the matching distance is not positive, a place is not finite,
///                                or an id is there twice in a list.
ClearMot clearMot(const std::vector<TrackingFrame>& frames, const ClearMotParams& params = {});

}  // namespace heel
