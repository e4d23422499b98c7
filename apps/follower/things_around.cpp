// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/things_around.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

// The robot has run into something if it is told to drive faster than kDrives_mps, and is slower
// than kMoves_mps for kStalls_s. What it touches may be anywhere within kFeels_rad of its heading.
constexpr double kDrives_mps = 0.1;
constexpr double kMoves_mps = 0.02;
constexpr double kStalls_s = 0.5;
constexpr double kFeels_rad = 0.6;

Vector2d floorOf(const Eigen::Vector3f& point) { return point.head<2>().cast<double>(); }

}  // namespace

ThingsAround::ThingsAround(const RobotDescription& robot, const FollowerParams& params,
                           const OccupancyGrid& floor)
    : body_(params.drive.limits),
      wheels_latency_s_(robot.wheels_latency_s),
      mapped_within_m_(params.mapped_within_m),
      beside_people_m_(params.beside_people_m),
      person_m_(params.target_radius_m),
      floor_(floor),
      layer_(params.obstacles),
      apart_(layer_.window()) {
  pictures_.emplace_back(robot.camera, params.obstacle_points);
  if (robot.floor_camera) pictures_.emplace_back(*robot.floor_camera, params.floor_points);
}

void ThingsAround::begin(double stamp_s, const FloorPose& robot,
                         const std::optional<FloorDisc>& target,
                         const std::vector<FloorDisc>& people) {
  robot_ = robot;
  layer_.begin(stamp_s, robot, target, people);
}

void ThingsAround::addScan(const LaserScan& scan, const FloorPose& T_base_scanner) {
  layer_.addScan(scan, T_base_scanner, [this](const Vector2d& place) { return isMapped(place); });
}

void ThingsAround::feel(const VelocityCommand& asked, const VelocityCommand& measured,
                        double elapsed_s) {
  const bool is_held =
      std::abs(asked.forward_mps) > kDrives_mps && std::abs(measured.forward_mps) < kMoves_mps;
  stalled_s_ = is_held ? stalled_s_ + elapsed_s : 0.0;
  if (stalled_s_ < kStalls_s + wheels_latency_s_) return;
  stalled_s_ = 0.0;
  const double reach_m = body_.radius_m + layer_.params().cell_size_m;
  for (double angle = -kFeels_rad; angle <= kFeels_rad; angle += 0.1) {
    const Vector2d rim = reach_m * Vector2d(std::cos(angle), std::sin(angle));
    layer_.touch(asked.forward_mps > 0.0 ? Vector2d(body_.front_m + rim.x(), rim.y())
                                         : Vector2d(body_.back_m - rim.x(), rim.y()));
  }
}

const std::vector<Vector2d>& ThingsAround::stepsFrom(const FloorPose& then) {
  const FloorPose T_then_world = then.inverse();
  steps_.clear();
  for (const Vector2d& step : layer_.steps()) steps_.push_back(T_then_world * step);
  return steps_;
}

void ThingsAround::addPoints(RobotCamera by, const std::vector<Eigen::Vector3f>& points,
                             const FloorPose& T_base_then) {
  unmapped_.clear();
  for (const Eigen::Vector3f& point : points) {
    const Vector2d seen = T_base_then * floorOf(point);
    if (isMapped(robot_ * seen)) continue;
    unmapped_.emplace_back(static_cast<float>(seen.x()), static_cast<float>(seen.y()), point.z());
  }
  layer_.addPoints(unmapped_);
  layer_.clear([&, T_then_base = T_base_then.inverse()](const Eigen::Vector3f& point) {
    const Eigen::Vector2f seen = (T_then_base * floorOf(point)).cast<float>();
    return pictures_.at(indexOf(by)).seesThrough({seen.x(), seen.y(), point.z()});
  });
}

const OccupancyGrid& ThingsAround::apartFrom(const std::vector<MovingPerson>& people) {
  apart_ = layer_.window();
  for (const MovingPerson& person : people) {
    const double reach_m = person.rests_s > 0.0 ? person.radius_m + beside_people_m_ : person_m_;
    const GridCell low = apart_.cellAt(person.position.array() - reach_m);
    const GridCell high = apart_.cellAt(person.position.array() + reach_m);
    for (int y = std::max(low.y, 0); y <= std::min(high.y, apart_.height() - 1); ++y) {
      for (int x = std::max(low.x, 0); x <= std::min(high.x, apart_.width() - 1); ++x) {
        const GridCell cell{x, y};
        if ((apart_.center(cell) - person.position).norm() > reach_m) continue;
        apart_.at(cell) = Occupancy::kFree;
      }
    }
  }
  return apart_;
}

std::optional<Vector2d> ThingsAround::firstBetween(const Vector2d& from, const Vector2d& to) const {
  const OccupancyGrid& window = layer_.window();
  const double step_m = window.cell_size_m(), way_m = (to - from).norm() - person_m_;
  const Vector2d ahead = (to - from).normalized();
  for (double gone_m = body_.radius_m; gone_m < way_m; gone_m += step_m) {
    const Vector2d place = from + gone_m * ahead;
    const GridCell cell = window.cellAt(place);
    if (window.contains(cell) && window.at(cell) == Occupancy::kOccupied) return place;
  }
  return std::nullopt;
}

bool ThingsAround::isMapped(const Vector2d& place) const {
  return floor_.isOccupiedWithin(place, mapped_within_m_);
}

}  // namespace heel
