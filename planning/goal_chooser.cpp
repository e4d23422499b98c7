// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/goal_chooser.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kKeep_m = 0.25;       // A new place must be cheaper by what this much way costs.
constexpr double kWayCost = 1.0;       // Per metre of straight line from the robot.
constexpr double kStandoffCost = 2.5;  // Per metre nearer or further than standoff_m.
constexpr double kDoorwayCost = 2.0;   // In the middle of a passage; less towards its rims.
constexpr double kNarrowCost = 0.5;    // Of no more room than needed; 0 with 0.3 m more.
constexpr double kUnseenCost = 3.0;    // Of a place from which, or on whose way, they are not seen.

using Eigen::Vector2d;

constexpr double kImpossible = std::numeric_limits<double>::infinity();
constexpr int kBearings = 32;

}  // namespace

GoalChooser::GoalChooser(const GoalChooserParams& params) : params_(params) {
  const auto& p = params;
  if (!(p.standoff_m > 0.0 && p.radius_m > 0.0 && p.margin_m >= 0.0)) {
    throw std::invalid_argument(
        "GoalChooserParams: standoff_m and radius_m must be positive, margin_m not negative");
  }
  if (!(p.nearest_share > 0.0 && p.nearest_share <= 1.0 && p.furthest_share >= 1.0)) {
    throw std::invalid_argument(
        "GoalChooserParams: nearest_share must be over 0 and at most 1, furthest_share at least 1");
  }
}

std::optional<Vector2d> GoalChooser::choose(const MovingPerson& target, const Vector2d& robot,
                                            Clearance clearance, LineOfSight sees,
                                            const std::vector<DoorwayOnMap>& doorways) {
  const GoalChooserParams& p = params_;
  if (!target.position.allFinite() || !target.velocity.allFinite() || !robot.allFinite()) {
    last_.reset();
    return std::nullopt;
  }
  const Vector2d person = target.position + p.lead_s * target.velocity;
  const double need = p.radius_m + p.margin_m;
  const double nearest_m = p.nearest_share * p.standoff_m;
  const double furthest_m = p.furthest_share * p.standoff_m;

  const auto costIfSeen = [&](const Vector2d& at) {
    const double off = (person - at).norm();
    const double room = clearance(at);
    if (off < nearest_m || off > furthest_m || !(room >= need)) return kImpossible;
    double passage = 0.0;
    for (const DoorwayOnMap& d : doorways) {
      passage = std::max(passage, inPassage(d, at, p.doorway_depth_m, p.radius_m));
    }
    return kWayCost * (at - robot).norm() + kStandoffCost * std::abs(off - p.standoff_m) +
           kDoorwayCost * passage + kNarrowCost * std::clamp(1.0 - (room - need) / 0.3, 0.0, 1.0);
  };

  const Vector2d to_person = person - robot;
  const double keeps_cos = std::cos(p.half_view_rad);
  const auto isSeen = [&](const Vector2d& at) {
    const Vector2d way = at - robot;
    return way.dot(to_person) >= keeps_cos * way.norm() * to_person.norm() &&
           sees(at, target.position);
  };

  Vector2d best = robot;
  double least = kImpossible;
  const auto consider = [&](const Vector2d& place, double favour) {
    double cost = costIfSeen(place) - favour;
    if (cost < least && !isSeen(place)) cost += kUnseenCost;  // Sight takes longest to tell.
    if (cost >= least) return;
    least = cost;
    best = place;
  };
  const Vector2d from = robot - person;
  const double first = from.norm() > 1e-6 ? std::atan2(from.y(), from.x()) : 0.0;
  for (const double distance : {p.standoff_m, 0.5 * (p.standoff_m + nearest_m),
                                0.5 * (p.standoff_m + furthest_m), furthest_m - 1e-9}) {
    for (int i = 0; i < kBearings; ++i) {
      const double bearing = first + 2.0 * M_PI * i / kBearings;
      consider(person + distance * Vector2d(std::cos(bearing), std::sin(bearing)), 0.0);
    }
  }
  consider(robot, 0.0);  // Where it stands may do.
  if (last_) consider(*last_, kKeep_m * kWayCost);
  last_.reset();
  if (least < kImpossible) last_ = best;
  return last_;
}

}  // namespace heel
