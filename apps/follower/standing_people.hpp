// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Around who stands a path leads another way, also while nobody looks at them.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/planning/function_ref.hpp>
#include <heel/planning/surroundings.hpp>

#include <cstddef>
#include <vector>

namespace heel {

struct StandingPeopleParams {
  double slower_than_mps = 0.0;  ///< Who is no faster stands.
  double beside_m = 0.0;         ///< Room that is left beside their body.
  double near_m = 0.0;           ///< People so near to where somebody stood are them.
};

/// Discs around who stands. Who stood, and is neither seen nor among the people any more, stays
/// for half a minute, or until they are known to have left: else the robot would drive into them
/// once it has turned away.
class StandingPeople {
 public:
  explicit StandingPeople(const StandingPeopleParams& params) : params_(params) {}

  /// @param people  Who is known of now, but for the target; in the frame of the discs.
  /// @param has_left  Whether nobody is at a place any more.
  void note(double stamp_s, const std::vector<MovingPerson>& people,
            FunctionRef<bool(const Eigen::Vector2d&)> has_left);

  const std::vector<FloorDisc>& discs() const { return discs_; }
  /// So many of the first discs are of people who are not among `people`, only remembered.
  std::size_t remembered() const { return remembered_; }

 private:
  StandingPeopleParams params_;
  std::vector<FloorDisc> discs_;
  std::vector<double> seen_s_;  // theirs
  std::size_t remembered_ = 0;
};

}  // namespace heel
