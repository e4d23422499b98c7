// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/goal_chooser.hpp>
#include <heel/planning/wayside.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 24;
constexpr double kRing_m = 0.2;
constexpr double kAway_m = 1.0;  // The robot keeps this far from people.
/// Cosine of the least angle between the way to a place and the direction of the person.
constexpr double kTowards = 0.3;

}  // namespace

bool leavesRoom(const Vector2d& place, const Vector2d& person, Clearance clearance,
                const WaysideParams& params) {
  const Vector2d to = person - place;
  const double first = std::atan2(to.y(), to.x());
  const double aside_m = params.radius_m + params.person_m;
  const auto isOpen = [&](double side) {
    for (int i = 1; i <= kPlaces / 4; ++i) {
      const double bearing = first + side * 2.0 * M_PI * i / kPlaces;
      const Vector2d p = place + aside_m * Vector2d(std::cos(bearing), std::sin(bearing));
      if (!(clearance(p) >= params.person_m)) return false;  // NaN too
    }
    return true;
  };
  return isOpen(1.0) || isOpen(-1.0);
}

void findWaysides(const Vector2d& robot, const std::vector<Vector2d>& people, Clearance clearance,
                  const std::vector<DoorwayOnMap>& doorways, const WaysideParams& params,
                  std::vector<Vector2d>& out) {
  out.clear();
  const auto blocks = [&](const Vector2d& place) {
    return isInPassage(doorways, place, params.doorway_depth_m, params.radius_m);
  };
  const auto isGood = [&](const Vector2d& place, bool leaves_room) {
    if (!(clearance(place) >= params.radius_m + params.margin_m) || blocks(place)) return false;
    const Vector2d way = place - robot;
    return std::all_of(people.begin(), people.end(), [&](const Vector2d& person) {
      return (place - person).norm() >= kAway_m &&
             way.dot((person - robot).normalized()) <= kTowards * way.norm() &&
             (!leaves_room || leavesRoom(place, person, clearance, params));
    });
  };
  const auto add = [&](bool leaves_room) {
    for (double ring_m = kRing_m; ring_m <= params.reach_m; ring_m += kRing_m) {
      for (int i = 0; i < kPlaces; ++i) {
        const double bearing = 2.0 * M_PI * i / kPlaces;
        const Vector2d place = robot + ring_m * Vector2d(std::cos(bearing), std::sin(bearing));
        const bool is_new = std::none_of(out.begin(), out.end(), [&](const Vector2d& other) {
          return (other - place).norm() < params.apart_m;
        });
        if (is_new && isGood(place, leaves_room)) out.push_back(place);
      }
    }
  };
  add(true);
  if (blocks(robot)) add(false);
}

}  // namespace heel
