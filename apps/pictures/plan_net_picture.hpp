// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A Petri Net Plan as a picture.
#pragma once

#include <heel/planning/petri_plan.hpp>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace heel {

/// In the units of a PNML file: about 100 from a place to its transition, y down.
struct NetLayout {
  std::vector<Eigen::Vector2d> places;
  std::vector<Eigen::Vector2d> transitions;
};

/// The file's own positions where it has them all; else one column after the other, in the order in
/// which tokens get there.
NetLayout layoutNet(const PetriNet& net);

/// Draws a plan: places as circles with what runs there, transitions as bars with what they wait
/// for, the tokens of the start.
/// @param summary  A line under the plan's name.
cv::Mat drawPlanNet(const PetriPlan& plan, const std::string& summary);

}  // namespace heel
