// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/goal_chooser.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kImpossible = std::numeric_limits<double>::infinity();
constexpr int kBearings = 32;

}  // namespace

GoalChooser::GoalChooser(const GoalChooserParams& params) : params_(params) {
  const auto& p = params;
  if (!(p.least_standoff_m > 0.0) || !(p.standoff_m >= p.least_standoff_m) ||
      !(p.most_standoff_m >= p.standoff_m) || !(p.radius_m > 0.0) || !(p.margin_m >= 0.0) ||
      !(p.keep_m >= 0.0)) {
    throw std::invalid_argument("the goal chooser's distances are out of order");
  }
}

double inPassage(const DoorwayOnMap& doorway, const Vector2d& point, double depth_m,
                 double radius_m) {
  const Vector2d local = doorway.local(point).cwiseAbs();
  // Whoever goes through is as wide as the doorway; the robot's edge must not be in there.
  const double across = 0.5 * doorway.width_m + radius_m;
  if (local.x() >= depth_m || local.y() >= across) return 0.0;
  return (1.0 - local.x() / depth_m) * std::min(1.0, 2.0 * (1.0 - local.y() / across));
}

std::optional<StandPlace> GoalChooser::choose(const MovingPerson& target, const FloorPose& robot,
                                              Clearance clearance, LineOfSight sees,
                                              const std::vector<DoorwayOnMap>& doorways) {
  const GoalChooserParams& p = params_;
  if (!target.position.allFinite() || !target.velocity.allFinite() || !robot.position.allFinite()) {
    last_.reset();
    return std::nullopt;
  }
  const Vector2d person = target.position + p.lead_s * target.velocity;
  const double speed = target.velocity.norm();
  const double need = p.radius_m + p.margin_m;

  const auto judge = [&](const Vector2d& at) -> StandPlace {
    StandPlace out;
    out.cost = kImpossible;
    const Vector2d to = person - at;
    const double off = to.norm();
    const double room = clearance(at);
    if (off < p.least_standoff_m || off > p.most_standoff_m || !(room >= need)) return out;
    const double way = (at - robot.position).norm();
    double passage = 0.0;
    for (const DoorwayOnMap& d : doorways) {
      passage = std::max(passage, inPassage(d, at, p.doorway_depth_m, p.radius_m));
    }
    out.in_doorway = passage > 0.0;
    out.in_view = sees(at, target.position);
    out.pose = {at, std::atan2(to.y(), to.x())};
    out.cost = p.way_cost * way + p.standoff_cost * std::abs(off - p.standoff_m) +
               p.doorway_cost * passage + (out.in_view ? 0.0 : p.unseen_cost);
    out.cost += p.narrow_cost * std::clamp(1.0 - (room - need) / 0.3, 0.0, 1.0);
    if (speed > 0.1) {
      const double ahead = -to.dot(target.velocity) / (off * speed);  // 1 = right before them.
      out.cost += p.ahead_cost * std::max(ahead, 0.0) * std::min(speed, 1.0);
    }
    return out;
  };

  StandPlace best;
  best.cost = kImpossible;
  const Vector2d from = robot.position - person;
  const double first = from.norm() > 1e-6 ? std::atan2(from.y(), from.x()) : 0.0;
  const double middle = 0.5 * (p.standoff_m + p.most_standoff_m);
  for (const double distance : {p.standoff_m, 0.5 * (p.standoff_m + p.least_standoff_m), middle,
                                p.most_standoff_m - 1e-9}) {
    for (int i = 0; i < kBearings; ++i) {
      const double bearing = first + 2.0 * M_PI * i / kBearings;
      const StandPlace place =
          judge(person + distance * Vector2d(std::cos(bearing), std::sin(bearing)));
      if (place.cost < best.cost) best = place;
    }
  }
  // Where it stands may do.
  const StandPlace here = judge(robot.position);
  if (here.cost < best.cost) best = here;
  if (last_) {
    const StandPlace kept = judge(*last_);
    if (kept.cost < best.cost + p.keep_m * p.way_cost) best = kept;
  }
  if (best.cost == kImpossible) {
    last_.reset();
    return std::nullopt;
  }
  last_ = best.pose.position;
  return best;
}

}  // namespace heel
