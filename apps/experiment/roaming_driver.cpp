// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/roaming_driver.hpp>
#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/path_driver.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kRoamCell_m = 0.1;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr double kPi = 3.14159265358979;

}  // namespace

RoamingDriver::RoamingDriver(const Scene& scene, std::uint64_t seed) : random_(hashOf(seed, 71)) {
  for (const ScenePerson& person : scene.people) people_.push_back(person.start);
  const FloorBounds bounds = floorBounds(scene);
  const Eigen::Vector2d size = (bounds.high - bounds.low) / kRoamCell_m;
  room_ = OccupancyGrid(bounds.low, kRoamCell_m, static_cast<int>(size.x()) + 1,
                        static_cast<int>(size.y()) + 1, Occupancy::kOccupied);
  const FloorPlan plan(scene);
  const double needed_m = scene.robot.drive.radius_m + 0.08;
  for (GridCell c; c.y < room_.height(); ++c.y) {
    for (c.x = 0; c.x < room_.width(); ++c.x) {
      if (plan.clearance(room_.center(c)) >= needed_m) room_.at(c) = Occupancy::kFree;
    }
  }
  // Goals are where the scene's robot could get.
  goal_ = scene.robot.start;
  if (!findWay()) throw std::runtime_error(scene.name + ": the robot has no room at its start");
  for (GridCell c; c.y < room_.height(); ++c.y) {
    for (c.x = 0; c.x < room_.width(); ++c.x) {
      if (wayFrom(c) < kFar) free_.push_back(c);
    }
  }
}

FloorPose RoamingDriver::randomPose() {
  for (;;) {
    const auto pick =
        static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(free_.size())));
    const Eigen::Vector2d place = room_.center(free_[pick]);
    const double yaw = random_.uniform(-kPi, kPi);
    const bool crowded = std::any_of(people_.begin(), people_.end(), [&](const auto& person) {
      return (person - place).norm() < 1.0;
    });
    if (!crowded) return {place, yaw};
  }
}

double RoamingDriver::wayFrom(const GridCell& cell) const {
  return room_.contains(cell) ? static_cast<double>(way_m_[room_.index(cell)])
                              : std::numeric_limits<double>::infinity();
}

bool RoamingDriver::findWay() {
  using Entry = std::pair<float, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  way_m_.assign(room_.cells().size(), kFar);
  const GridCell goal = room_.cellAt(goal_);
  if (!room_.contains(goal) || room_.at(goal) != Occupancy::kFree) return false;
  way_m_[room_.index(goal)] = 0.0F;
  open.push({0.0F, {goal.x, goal.y}});
  while (!open.empty()) {
    const auto [way, at] = open.top();
    open.pop();
    if (way > way_m_[room_.index({at.first, at.second})]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const GridCell next{at.first + dx, at.second + dy};
        if (!room_.contains(next) || room_.at(next) != Occupancy::kFree) continue;
        const float there = way + static_cast<float>(kRoamCell_m * std::hypot(dx, dy));
        if (there >= way_m_[room_.index(next)]) continue;
        way_m_[room_.index(next)] = there;
        open.push({there, {next.x, next.y}});
      }
    }
  }
  return true;
}

void RoamingDriver::chooseGoal(const Eigen::Vector2d& from) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    goal_ = randomPose().position;
    if ((goal_ - from).norm() > 2.0) break;
  }
  has_goal_ = findWay();
  stuck_ = 0;
}

VelocityCommand RoamingDriver::drive(const WorldTruth& truth) {
  const FloorPose& robot = truth.robot;
  if (!has_goal_ || (goal_ - robot.position).norm() < 0.3 || stuck_ > 60) {
    chooseGoal(robot.position);
  }
  // Down the field of ways, some steps ahead.
  GridCell at = room_.cellAt(robot.position);
  for (int step = 0; step < 4; ++step) {
    GridCell best = at;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const GridCell next{at.x + dx, at.y + dy};
        if (wayFrom(next) < wayFrom(best)) best = next;
      }
    }
    at = best;
  }
  VelocityCommand command = steerTo(robot, room_.center(at));
  if (isSomebodyAhead(truth)) command.forward_mps = 0.0;
  const bool still = std::abs(truth.robot_speed.forward_mps) < 0.02 &&
                     std::abs(truth.robot_speed.turn_radps) < 0.05;
  stuck_ = still ? stuck_ + 1 : 0;
  return command;
}

}  // namespace heel
