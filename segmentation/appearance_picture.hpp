// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// An appearance model as a picture.
#pragma once

#include <heel/segmentation/appearance_model.hpp>

#include <opencv2/core/mat.hpp>

namespace heel {

/// Draws, a row for each band: the person's colours and those of the room (areas as their shares),
/// the colours that pass the filter, the person's D_H and D_V of the paper, and the errors at each
/// threshold with the one that was chosen. CV_8UC3.
cv::Mat drawAppearance(const AppearanceModel& model);

}  // namespace heel
