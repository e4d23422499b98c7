// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How stereo pairs are matched.
#pragma once

namespace heel {

/// Semi-global block matching. Defaults suit people indoors from 0.8 m at 640x480 (focal length
/// about 500 px, baseline about 0.1 m); `disparities` bounds the nearest depth, fx * baseline / it.
struct StereoMatcherParams {
  int disparities = 64;  ///< So many disparities are tried, from 0 on; a multiple of 16, <= 256.
  int block_size = 5;    ///< Edge of the block whose costs are summed [px]; odd, <= 5.
  int p1 = 100;          ///< Penalty where the disparity changes by 1 from a pixel to the next.
  int p2 = 600;          ///< Penalty where the disparity changes by more than 1; > p1.
  /// Greater gradients of the image count as this one; odd, in [15, 63].
  int prefilter_cap = 31;
  /// By how much the best cost must beat the second best; in [0, 99].
  int uniqueness_percent = 10;
  /// Greatest difference between the disparities of both views [px], >= 1.
  int max_left_right_difference = 1;
  int speckle_size = 100;  ///< Islands of fewer pixels than this are dropped; 0 keeps all.

  /// Masked matching only: so many pixels around the mask are matched with it, so that its rim is
  /// matched as well as its middle.
  int margin_px = 6;
  /// Masked matching only: the least share of masked pixels in the 24x24 px around a pixel. Pixels
  /// in specks can't be matched reliably and are dropped (and counted).
  double min_support = 0.1;
};

/// The parameters themselves.
/// @throws std::invalid_argument  if one is out of its range.
StereoMatcherParams checked(const StereoMatcherParams& params);

}  // namespace heel
