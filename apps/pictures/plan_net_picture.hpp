// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A Petri Net Plan as a picture.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <opencv2/core/mat.hpp>

#include <string>

namespace heel {

/// Draws a plan: places as circles with what runs there, transitions as bars with what they wait
/// for, the tokens of the start.
/// @param summary  A line under the plan's name.
cv::Mat drawPlanNet(const PetriPlan& plan, const std::string& summary);

}  // namespace heel
