// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which pixels of a mask stand in company.
#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// What was left of a mask.
struct SupportCount {
  int wanted = 0;  ///< Non-zero pixels of the mask.
  int kept = 0;    ///< Of them, those with support.
};

/// Keeps the pixels of `mask` around which enough others are set, and drops lone specks: of the
/// three by three cells of 8x8 px around a pixel, a share of at least `min_share` must be set.
///
/// @param mask  CV_8UC1, not 0 where set.
/// @param kept   Out: CV_8UC1, 255 where kept; its memory is reused.
/// @param cells  Scratch; its memory is reused.
SupportCount keepSupported(const cv::Mat& mask, double min_share, cv::Mat& kept,
                           std::vector<int>& cells);

}  // namespace heel
