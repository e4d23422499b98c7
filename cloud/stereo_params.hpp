// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How stereo pairs are matched.
#pragma once

namespace heel {

/// Semi-global block matching. Defaults suit people indoors from 0.8 m at 640x480 (focal length
/// about 500 px, baseline about 0.1 m); `disparities` bounds the nearest depth, fx * baseline / it.
struct StereoMatcherParams {
  int disparities = 64;    ///< 0, 1, ... this many less one are tried; a multiple of 16, <= 256.
  int block_size = 5;      ///< Edge of the block whose costs are summed [px], odd, <= 5.
  int p1 = 100;            ///< Penalty where the disparity changes by 1.
  int p2 = 600;            ///< Penalty where it changes by more; > p1.
  int prefilter_cap = 31;  ///< Gradients beyond it count as it; odd, in [15, 63].
  int uniqueness_percent = 10;        ///< By how much the best cost must win; in [0, 99].
  int max_left_right_difference = 1;  ///< Between the disparities of both views [px], >= 1.
  int speckle_size = 100;             ///< Islands of fewer pixels are dropped; 0 keeps all.
  int speckle_range = 1;              ///< Neighbours of one island differ by no more [px].

  /// Masked matching only: so many pixels around the mask are matched with it, so that the paths
  /// arrive with a history and blocks at its edge see both sides.
  int margin_px = 6;
  /// Masked matching only: the least share of masked pixels in the 24x24 px around a pixel.
  /// Pixels in specks can't be matched reliably and are dropped (and counted).
  double min_support = 0.1;
};

/// The parameters themselves.
/// @throws std::invalid_argument  if one is out of its range.
StereoMatcherParams checked(const StereoMatcherParams& params);

}  // namespace heel
