// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/path_driver.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

constexpr double kThere_m = 0.1;
constexpr double kPerson_m = 0.75;  // As near as people's middles may come ahead.

}  // namespace

VelocityCommand steerTo(const FloorPose& robot, const Eigen::Vector2d& place) {
  const double turn = bearingOf(robot, place);
  VelocityCommand command;
  command.turn_radps = std::clamp(1.5 * turn, -0.8, 0.8);
  command.forward_mps = std::abs(turn) > 0.7 ? 0.0 : kDrivenSpeed_mps * std::cos(turn);
  return command;
}

bool isSomebodyAhead(const WorldTruth& truth) {
  return std::any_of(truth.people.begin(), truth.people.end(), [&](const PersonTruth& person) {
    const Eigen::Vector2d off = truth.robot.inverse() * person.position;
    return off.norm() < kPerson_m && off.x() > 0.0;
  });
}

PathDriver::PathDriver(FloorPath path) : path_(std::move(path)) {}

VelocityCommand PathDriver::drive(const WorldTruth& truth) {
  while (next_ < path_.size() && (path_[next_] - truth.robot.position).norm() < kThere_m) ++next_;
  if (next_ == path_.size()) return {};
  VelocityCommand command = steerTo(truth.robot, path_[next_]);
  if (isSomebodyAhead(truth)) command.forward_mps = 0.0;
  return command;
}

}  // namespace heel
