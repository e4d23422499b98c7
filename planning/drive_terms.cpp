// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/drive_terms.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr double kPathOff_m = 0.3;  // Mean distance at which the cost of leaving the path is half.

using Eigen::Vector2d;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr std::size_t kStride = 5;  // The slow terms look at every fifth pose.

double square(double x) { return x * x; }

/// The pose at `step`, or the last one before anything is touched.
const FloorPose& clearPose(const DriveScene& scene, const DriveOption& option, std::size_t step) {
  return option.clear_steps > 0 ? option.poses[std::min(step, option.clear_steps - 1)]
                                : scene.now.pose;
}

/// Early progress counts too: of two futures that end at one place the faster is better.
double progress(const DriveLimits& limits, const DriveScene& scene, const DriveOption& option) {
  constexpr std::size_t kParts = 3;
  constexpr double kOff = 0.4;  // What a metre beside the path is worth of one along it.
  const double before = scene.start.left_m + kOff * scene.start.off_m;
  double made = 0.0, possible = 0.0;
  for (std::size_t part = 1; part <= kParts; ++part) {
    const std::size_t step = part * option.steps / kParts;
    const FloorPose& pose = clearPose(scene, option, step - 1);
    const PathAhead::Place place = scene.path->locate(pose.position);
    made += before - place.left_m - kOff * place.off_m;
    possible +=
        std::min(limits.max_speed_mps * limits.period_s * static_cast<double>(step), before);
  }
  return possible < 1e-3 ? 0.0 : 1.0 - std::clamp(made / possible, -1.0, 1.0);
}

double offPath(const DriveScene& scene, const DriveOption& option) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = kStride - 1; i < option.steps; i += kStride, ++count) {
    const double off2 = square(scene.path->locate(option.poses[i].position).off_m);
    sum += off2 / (off2 + square(kPathOff_m));
  }
  return count > 0 ? sum / count : 0.0;
}

double headingOff(const DriveScene& scene, const DriveOption& option) {
  const FloorPose& end = clearPose(scene, option, option.steps - 1);
  const double direction = scene.path->locate(end.position).direction_rad;
  return 0.5 - 0.5 * std::cos(end.yaw_rad - direction);
}

double nearThings(const DriveTermParams& params, const DriveOption& option) {
  double sum = 0.0;
  for (std::size_t i = 0; i < option.steps; ++i) {
    if (option.gaps_m[i] < params.comfort_m) {
      sum += square(1.0 - std::max(option.gaps_m[i], 0.0) / params.comfort_m);
    }
  }
  return sum / static_cast<double>(option.steps);
}

double nearPeople(const DriveLimits& limits, const DriveTermParams& params, const DriveScene& scene,
                  const DriveOption& option) {
  if (scene.people->empty()) return 0.0;
  constexpr double kTouch = 1.2;
  bool touched = false;
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < option.steps; ++i) {
    const double t = limits.period_s * static_cast<double>(i + 1);
    if (t > params.foresight_s) break;
    const double weight = 1.0 - 0.5 * t / params.foresight_s;
    weights += weight;
    const double room = roomToPeople(*scene.people, limits, option.poses[i], t);
    // After a touch the future ends: people don't walk through the robot. From whoever touches it
    // now it may get away.
    touched = touched || room < std::min(0.0, scene.people_room_m);
    const double lack =
        touched ? kTouch : std::clamp(1.0 - room / params.people_comfort_m, 0.0, kTouch);
    sum += weight * square(lack);
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

double outOfView(const DriveTermParams& params, const DriveScene& scene,
                 const DriveOption& option) {
  if (!scene.face) return 0.0;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = kStride - 1; i < option.steps; i += kStride, ++count) {
    const Vector2d to = *scene.face - option.poses[i].position;
    if (to.norm() < 0.1) continue;
    const double off = std::abs(wrapped(std::atan2(to.y(), to.x()) - option.poses[i].yaw_rad));
    sum += std::max(off - params.half_view_rad, 0.0);
  }
  return count > 0 ? sum / count : 0.0;
}

double change(const DriveLimits& limits, const DriveScene& scene, const DriveOption& option) {
  return std::abs(option.command.forward_mps - scene.last.forward_mps) / limits.max_speed_mps +
         std::abs(option.command.turn_radps - scene.last.turn_radps) / limits.max_turn_radps;
}

}  // namespace

const char* nameOf(DriveTerm term) {
  static constexpr std::array<const char*, kDriveTerms> kNames = {
      "progress", "path", "heading", "clearance", "people", "view", "smooth"};
  return kNames[static_cast<std::size_t>(term)];
}

double roomToPeople(const std::vector<MovingPerson>& people, const DriveLimits& limits,
                    const FloorPose& pose, double after_s) {
  const FloorLine axis = axisOf(limits, pose);
  double least = kUnbounded;
  for (const MovingPerson& p : people) {
    const Vector2d there = p.position + after_s * p.velocity;
    least = std::min(least, (there - axis.nearest(there)).norm() - p.radius_m - limits.radius_m);
  }
  return least;
}

double roomToWay(const MovingPerson& person, const DriveLimits& limits, const FloorPose& pose,
                 double after_s) {
  const FloorLine way{person.position, person.position + after_s * person.velocity};
  return distanceBetween(way, axisOf(limits, pose)) - person.radius_m - limits.radius_m;
}

double roomToWays(const std::vector<MovingPerson>& people, const DriveLimits& limits,
                  const FloorPose& pose, double after_s) {
  double least = kUnbounded;
  for (const MovingPerson& p : people) {
    least = std::min(least, roomToWay(p, limits, pose, after_s));
  }
  return least;
}

DriveScores driveCosts(const DriveLimits& limits, const DriveTermParams& params,
                       const DriveScene& scene, const DriveOption& option) {
  const bool on_way = scene.path != nullptr && !scene.path->empty();
  return {on_way ? progress(limits, scene, option) : 0.0,
          on_way ? offPath(scene, option) : 0.0,
          on_way ? headingOff(scene, option) : 0.0,
          nearThings(params, option),
          nearPeople(limits, params, scene, option),
          outOfView(params, scene, option),
          change(limits, scene, option)};
}

double total(const DriveScores& costs, const DriveScores& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kDriveTerms; ++i) sum += weights[i] * costs[i];
  return sum;
}

}  // namespace heel
