// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A cloud's plan view as a picture.
#pragma once

#include <heel/apps/heel/planview/cloud_plan.hpp>

#include <opencv2/core/mat.hpp>

#include <string>

namespace heel {

/// The occupied cells, brighter where they are higher and tinted where they belong to a blob; the
/// blobs with their numbers and heights, those of a person's shape with a thick ring; the cloud's
/// origin as a wedge. X goes up, y to the left; a grid of metres. CV_8UC3, 720 x 640 or so.
/// @param title  Over the picture; cut where it has no room.
cv::Mat drawPlanView(const CloudPlan& plan, const std::string& title);

}  // namespace heel
