// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance filter on an image: which pixels have the target's colours (paper, section 3.1).
#pragma once

#include <heel/segmentation/color_table.hpp>

#include <opencv2/core/mat.hpp>

namespace heel {

/// Marks the pixels that pass `table`: the same answer as AppearanceFilter gives for their points.
///
/// @param image_bgr  CV_8UC3; a region of interest of a larger image will do.
/// @param mask       Out: CV_8UC1 of the same size, 255 where the colour passes and 0 elsewhere.
/// Its
///                   memory is reused if it fits, so it may be a region of a larger mask.
/// @throws std::invalid_argument  if the image is not CV_8UC3 or the table is empty.
void filterImage(const cv::Mat& image_bgr, const ColorTable& table, cv::Mat& mask);

}  // namespace heel
