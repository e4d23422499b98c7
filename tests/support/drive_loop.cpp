// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/drive_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace heel::test {

using Eigen::Vector2d;

double DrawnFloor::clearance(const Vector2d& p) const {
  double least = std::min((p - low).minCoeff(), (high - p).minCoeff());
  for (const Box& box : boxes) {
    const Vector2d off = (p - (box.low + box.high) / 2.0).cwiseAbs() - (box.high - box.low) / 2.0;
    least = std::min(least, off.cwiseMax(0.0).norm() + std::min(off.maxCoeff(), 0.0));
  }
  for (const Disc& disc : discs) {
    least = std::min(least, (p - disc.center).norm() - disc.radius_m);
  }
  return least;
}

DrawnFloor roomWithDoorway(double width_m) {
  DrawnFloor floor;
  floor.high = {6.0, 4.0};
  floor.boxes = {{{2.94, 0.0}, {3.06, 2.0 - width_m / 2.0}},
                 {{2.94, 2.0 + width_m / 2.0}, {3.06, 4.0}}};
  return floor;
}

DrawnFloor randomFloor(std::mt19937& random) {
  const auto draw = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  DrawnFloor floor;
  const double wall = draw(2.2, 3.8), gap = draw(0.6, 5.4), half = draw(0.8, 1.0) / 2.0;
  floor.boxes.push_back({{wall - 0.06, 0.0}, {wall + 0.06, gap - half}});
  floor.boxes.push_back({{wall - 0.06, gap + half}, {wall + 0.06, 6.0}});
  for (int i = 0; i < 4; ++i) {
    const Vector2d at(draw(0.3, 5.7), draw(0.3, 5.7)), half_size(draw(0.1, 0.5), draw(0.1, 0.5));
    floor.boxes.push_back({at - half_size, at + half_size});
    floor.discs.push_back({{draw(0.3, 5.7), draw(0.3, 5.7)}, draw(0.03, 0.3)});
  }
  return floor;
}

Vector2d randomFreePoint(const DrawnFloor& floor, double room_m, std::mt19937& random) {
  std::uniform_real_distribution<double> x(floor.low.x(), floor.high.x());
  std::uniform_real_distribution<double> y(floor.low.y(), floor.high.y());
  for (int i = 0; i < 10000; ++i) {
    const double px = x(random);
    const Vector2d p(px, y(random));
    if (floor.clearance(p) > room_m) return p;
  }
  return (floor.low + floor.high) / 2.0;
}

std::vector<Vector2d> wayOn(const DrawnFloor& floor, const Vector2d& from, const Vector2d& to,
                            double radius_m) {
  constexpr double kCell_m = 0.05;
  const Vector2d size = floor.high - floor.low;
  const int width = static_cast<int>(size.x() / kCell_m),
            height = static_cast<int>(size.y() / kCell_m);
  const auto center = [&](int i) {
    return Vector2d(floor.low + kCell_m * Vector2d(i % width + 0.5, i / width + 0.5));
  };
  const auto cellOf = [&](const Vector2d& p) {
    const Vector2d c = (p - floor.low) / kCell_m;
    return static_cast<int>(c.y()) * width + static_cast<int>(c.x());
  };
  const auto count = static_cast<std::size_t>(width * height);
  std::vector<double> room(count), cost(count, std::numeric_limits<double>::infinity());
  std::vector<int> before(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    room[i] = floor.clearance(center(static_cast<int>(i))) - radius_m;
  }
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const int goal = cellOf(to);
  cost[static_cast<std::size_t>(cellOf(from))] = 0.0;
  open.push({0.0, cellOf(from)});
  while (!open.empty()) {
    const auto [sum, cell] = open.top();
    open.pop();
    if (sum > cost[static_cast<std::size_t>(cell)]) continue;
    if (cell == goal) break;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = cell % width + dx, y = cell / width + dy;
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const auto next = static_cast<std::size_t>(y * width + x);
        if (room[next] < 0.06) continue;
        const double near = std::max(1.0 - room[next] / 0.3, 0.0);
        const double then = sum + kCell_m * std::hypot(dx, dy) * (1.0 + 2.0 * near);
        if (then >= cost[next]) continue;
        cost[next] = then;
        before[next] = cell;
        open.push({then, static_cast<int>(next)});
      }
    }
  }
  if (before[static_cast<std::size_t>(goal)] < 0) return {};
  std::vector<Vector2d> way = {to};
  for (int cell = goal; cell >= 0; cell = before[static_cast<std::size_t>(cell)]) {
    way.push_back(center(cell));
  }
  way.push_back(from);
  std::reverse(way.begin(), way.end());
  for (int pass = 0; pass < 20; ++pass) {
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
      const Vector2d moved = 0.5 * way[i] + 0.25 * (way[i - 1] + way[i + 1]);
      if (floor.clearance(moved) > std::min(floor.clearance(way[i]), radius_m + 0.15)) {
        way[i] = moved;
      }
    }
  }
  return way;
}

void LineWalker::step(double dt_s, const Vector2d& robot, double robot_radius_m) {
  const Vector2d way = to - person.position;
  if (way.norm() < 0.05) {
    person.velocity = Vector2d::Zero();
    std::swap(from, to);
    return;
  }
  const Vector2d velocity = speed_mps * way.normalized();
  const Vector2d off = robot - (person.position + dt_s * velocity);
  const bool into =
      off.dot(velocity) > 0.0 && off.norm() - person.radius_m - robot_radius_m < stop_gap_m;
  waited_s = into ? waited_s + dt_s : 0.0;
  if (waited_s > patience_s) {
    waited_s = 0.0;
    std::swap(from, to);
  }
  person.velocity = into ? Vector2d::Zero() : velocity;
  person.position += dt_s * person.velocity;
}

DriveLoop::DriveLoop(const DrawnFloor& drawn, const FloorPose& start,
                     const LocalPlannerParams& params, int late_periods)
    : floor(drawn), planner_(params), queue_(static_cast<std::size_t>(late_periods)) {
  state_.pose = start;
}

const LocalPlan& DriveLoop::step(const std::vector<Vector2d>& path,
                                 const std::optional<Vector2d>& face) {
  constexpr int kParts = 5;
  const DriveLimits& limits = planner_.params().limits;
  people_.clear();
  for (const LineWalker& walker : walkers) people_.push_back(walker.person);
  const auto clearance = [this](const Vector2d& p) { return floor.clearance(p); };
  plan_ = planner_.step(state_.pose, state_.speed, path, clearance, people_, face);
  queue_.push_back(plan_.command);
  const VelocityCommand command = queue_.front();
  queue_.erase(queue_.begin());
  if (std::abs(plan_.command.turn_radps) > 0.15) {
    if (plan_.command.turn_radps * last_turn_ < 0.0) ++turn_reversals_;
    last_turn_ = plan_.command.turn_radps;
  }
  for (int i = 0; i < kParts; ++i) {
    const double dt = limits.period_s / kParts;
    state_ = driven(limits, state_, command, dt);
    time_s_ += dt;
    const double speed = std::abs(state_.speed.forward_mps);
    way_m_ += speed * dt;
    if (speed > 0.02) moving_s_ += dt;
    least_gap_m_ = std::min(least_gap_m_, roomAround(limits, state_.pose, clearance));
    for (LineWalker& walker : walkers) {
      walker.step(dt, state_.pose.position, limits.radius_m);
      least_people_gap_m_ =
          std::min(least_people_gap_m_, (walker.person.position - state_.pose.position).norm() -
                                            walker.person.radius_m - limits.radius_m);
    }
  }
  return plan_;
}

}  // namespace heel::test
