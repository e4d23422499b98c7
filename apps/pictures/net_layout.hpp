// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the places and transitions of a net are drawn.
#pragma once

#include <heel/planning/petri_net.hpp>

#include <Eigen/Core>

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

}  // namespace heel
