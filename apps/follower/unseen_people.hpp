// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who was seen and is not any more; around who stands a path leads another way.
#pragma once

#include <heel/planning/function_ref.hpp>
#include <heel/planning/surroundings.hpp>

#include <vector>

namespace heel {

struct UnseenPeopleParams {
  double walks_on_s = 0.0;  ///< For so long whoever walked is expected to walk on.
  double beside_m = 0.0;    ///< Room that is left beside the body of who rests.
  double near_m = 0.0;      ///< People so near to where somebody should be are them.
};

/// Who is not among the people any more stays for half a minute if they stood, and walks on for a
/// while if they walked, or until they are known to have left. Else the robot would drive into them
/// once it has turned away.
class UnseenPeople {
 public:
  explicit UnseenPeople(const UnseenPeopleParams& params) : params_(params) {}

  /// @param people  Who is known of now, but for the target; those who are remembered are added.
  /// @param has_left  Whether nobody is at a place any more.
  void step(double stamp_s, std::vector<MovingPerson>& people,
            FunctionRef<bool(const Eigen::Vector2d&)> has_left);

  /// All of them who rest, with the room beside them.
  const std::vector<MovingPerson>& resting() const { return resting_; }

 private:
  struct Known {
    MovingPerson person;  // as last seen
    double seen_s;
  };
  static MovingPerson now(const Known& known, double stamp_s);
  static bool stands(const MovingPerson& person) {
    return person.velocity.norm() <= kSlowestWalk_mps;
  }

  UnseenPeopleParams params_;
  std::vector<Known> known_;
  std::vector<MovingPerson> resting_;
};

}  // namespace heel
