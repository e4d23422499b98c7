// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/obstacle_layer.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

// What stands for a time stands for so many times as long on once in 31 times: so seldom is what is
// forgotten still there.
constexpr double kStays = 30.0;
constexpr float kNothing_s = std::numeric_limits<float>::quiet_NaN();
/// World cells are ints; a place further off than this many of them is a fault.
constexpr double kFarthestCell = 1e9;

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("an obstacle layer's ") + what);
}

ObstacleLayerParams checked(const ObstacleLayerParams& p) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const auto notNegative = [](double x) { return x >= 0.0 && std::isfinite(x); };
  require(positive(p.cell_size_m), "cell size must be positive");
  require(p.size_m >= p.cell_size_m && p.size_m <= 1000.0 * p.cell_size_m,
          "window must be 1 to 1000 cells wide");
  require(p.max_height_m > p.min_height_m && std::isfinite(p.max_height_m - p.min_height_m),
          "greatest height must be above its least");
  require(positive(p.point_range_m), "range of points must be positive");
  require(p.min_points >= 1 && p.min_points <= 60000, "points in a cell must be 1 to 60000");
  require(notNegative(p.own_radius_m), "own radius must not be negative");
  require(std::isfinite(p.laser_height_m) && notNegative(p.laser_thickness_m),
          "laser plane must have a height and a thickness");
  require(notNegative(p.laser_min_range_m) && p.laser_max_range_m > p.laser_min_range_m &&
              std::isfinite(p.laser_max_range_m),
          "laser ranges must be positive and in order");
  require(positive(p.clear_spacing_m), "spacing of clearing beams must be positive");
  require(notNegative(p.clear_after_s), "time before clearing must not be negative");
  require(notNegative(p.min_memory_s) && p.max_memory_s >= p.min_memory_s &&
              std::isfinite(p.max_memory_s),
          "memory must not be negative, with its limits in order");
  return p;
}

bool finite(const FloorPose& pose) {
  return pose.position.allFinite() && std::isfinite(pose.yaw_rad);
}

/// `a` modulo `n`, never negative.
int modulo(int a, int n) {
  const int rest = a % n;
  return rest < 0 ? rest + n : rest;
}

}  // namespace

ObstacleLayer::ObstacleLayer(const ObstacleLayerParams& params)
    : params_(checked(params)),
      cells_per_edge_(static_cast<int>(std::lround(params.size_m / params.cell_size_m))),
      corner_{-cells_per_edge_ / 2, -cells_per_edge_ / 2},
      window_(params.cell_size_m * Eigen::Vector2d(corner_.x, corner_.y), params.cell_size_m,
              cells_per_edge_, cells_per_edge_) {
  const std::size_t count = window_.cells().size();
  cells_.resize(count);
  touched_.reserve(count);
  obstacles_.reserve(count);
  steps_.reserve(count);
  occupied_.resize(count, 0);
  stood_s_.resize(count, kNothing_s);
  transform_.compute(occupied_, cells_per_edge_, cells_per_edge_, params_.cell_size_m,
                     distances_m_);
}

bool ObstacleLayer::remembered(const Trace& trace) const {
  if (!trace.known) return false;
  const bool stands = trace.lasted_s() >= params_.min_memory_s;
  const double memory_s =
      stands ? std::min(kStays * trace.lasted_s(), params_.max_memory_s) : params_.min_memory_s;
  return clock_s_ - trace.seen_s <= memory_s;
}

void ObstacleLayer::see(Trace& trace, bool is_somebody) const {
  if (!remembered(trace)) {
    trace.since_s = clock_s_;
  } else if (is_somebody || clock_s_ - trace.seen_s > params_.min_memory_s) {
    trace.since_s += clock_s_ - trace.seen_s;  // It was not seen for any longer.
  }
  trace.seen_s = clock_s_;
  trace.known = true;
}

bool ObstacleLayer::mayClear(const Trace& trace) const {
  return trace.known && clock_s_ - trace.seen_s >= params_.clear_after_s;
}

GridCell ObstacleLayer::worldCell(const Eigen::Vector2d& point) const {
  return {static_cast<int>(std::floor(point.x() / params_.cell_size_m)),
          static_cast<int>(std::floor(point.y() / params_.cell_size_m))};
}

bool ObstacleLayer::inWindow(const GridCell& world_cell) const {
  return world_cell.x >= corner_.x && world_cell.y >= corner_.y &&
         world_cell.x < corner_.x + cells_per_edge_ && world_cell.y < corner_.y + cells_per_edge_;
}

std::size_t ObstacleLayer::slot(const GridCell& world_cell) const {
  return window_.index(
      {modulo(world_cell.x, cells_per_edge_), modulo(world_cell.y, cells_per_edge_)});
}

bool ObstacleLayer::leftOut(const Eigen::Vector2d& point) const {
  if ((point - T_world_base_.position).norm() < params_.own_radius_m) return true;
  return target_ && (point - target_->center).norm() <= target_->radius_m;
}

bool ObstacleLayer::isSomebody(const Eigen::Vector2d& point) const {
  return std::any_of(people_.begin(), people_.end(), [&](const FloorDisc& person) {
    return (point - person.center).norm() <= person.radius_m;
  });
}

void ObstacleLayer::requireFrame() const {
  if (!begun_) throw std::invalid_argument("an obstacle layer's frame must begin with begin()");
}

void ObstacleLayer::begin(double stamp_s, const FloorPose& T_world_base,
                          const std::optional<FloorDisc>& target,
                          const std::vector<FloorDisc>& people) {
  require(std::isfinite(stamp_s), "stamp must be finite");
  require(
      finite(T_world_base) && (T_world_base.position / params_.cell_size_m).norm() < kFarthestCell,
      "pose must be finite and near the origin");
  require(!target || (target->center.allFinite() && std::isfinite(target->radius_m)),
          "target must be finite");
  if (stamp_s_) clock_s_ += std::max(0.0, stamp_s - *stamp_s_);
  stamp_s_ = stamp_s;
  T_world_base_ = T_world_base;
  target_ = target;
  people_.assign(people.begin(), people.end());
  const GridCell middle = worldCell(T_world_base.position);
  roll({middle.x - cells_per_edge_ / 2, middle.y - cells_per_edge_ / 2});
  forgetUnderRobot();
  for (const std::size_t i : touched_)
    cells_[i].frame_points = 0;  // of a frame without its finish()
  touched_.clear();
  begun_ = true;
}

void ObstacleLayer::roll(const GridCell& corner) {
  const int n = cells_per_edge_;
  const GridCell old = std::exchange(corner_, corner);
  if (old == corner) return;
  // Columns and rows that enter take the places of those that leave.
  const auto entered = [n](int index, int before) { return index < before || index >= before + n; };
  for (int y = corner.y; y < corner.y + n; ++y) {
    const bool row_entered = entered(y, old.y);
    for (int x = corner.x; x < corner.x + n; ++x) {
      if (row_entered || entered(x, old.x)) cells_[slot({x, y})] = {};
    }
  }
}

void ObstacleLayer::forgetUnderRobot() {
  const double radius = params_.own_radius_m;
  const Eigen::Vector2d& at = T_world_base_.position;
  const GridCell low = worldCell(at.array() - radius);
  const GridCell high = worldCell(at.array() + radius);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const Eigen::Vector2d middle = params_.cell_size_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      if (inWindow({x, y}) && (middle - at).norm() < radius) cells_[slot({x, y})] = {};
    }
  }
}

void ObstacleLayer::addScan(const LaserScan& scan, const FloorPose& T_base_laser,
                            const std::function<bool(const Eigen::Vector2d&)>& is_mapped) {
  requireFrame();
  require(finite(T_base_laser) && T_base_laser.position.norm() <= params_.size_m,
          "laser must be on the robot");
  require(std::isfinite(scan.first_rad) && std::isfinite(scan.step_rad),
          "scan must have finite angles");
  const FloorPose laser = T_world_base_ * T_base_laser;
  const auto direction = [&](std::size_t beam) {
    const double angle = laser.yaw_rad + scan.angle(beam);
    return Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  // A single beam has no neighbours, so it clears all that it crosses.
  const double step = std::abs(scan.step_rad);
  const double dense_m = step > 0.0 ? params_.clear_spacing_m / step : params_.laser_max_range_m;
  const double clear_m = std::min(dense_m, params_.laser_max_range_m);
  // All beams clear before any end is set: of two beams through one cell, the one that ends wins.
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!(range_m >= params_.laser_min_range_m)) continue;  // NaN too
    // The last cell before the end may hold the same surface, seen with another error.
    clearAlong(laser.position, direction(i), std::min(range_m - params_.cell_size_m, clear_m),
               std::isfinite(range_m));
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (!(range_m >= params_.laser_min_range_m && range_m <= params_.laser_max_range_m)) continue;
    const Eigen::Vector2d end = laser.position + range_m * direction(i);
    const GridCell cell = worldCell(end);
    const bool is_known = is_mapped && is_mapped(end);
    if (inWindow(cell) && !leftOut(end) && !is_known) {
      see(cells_[slot(cell)].laser, isSomebody(end));
    }
  }
}

void ObstacleLayer::clearAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                               double length_m, bool has_echo) {
  // Every cell that the beam crosses, in order (Amanatides and Woo, 1987).
  if (!(length_m > 0.0)) return;
  GridCell at = worldCell(from);
  const auto toBorder = [&](double start, double slope, int index) {
    if (slope == 0.0) return std::numeric_limits<double>::infinity();
    const double border = params_.cell_size_m * (index + (slope > 0.0 ? 1 : 0));
    return (border - start) / slope;
  };
  double next_x = toBorder(from.x(), direction.x(), at.x);
  double next_y = toBorder(from.y(), direction.y(), at.y);
  const double along_x = params_.cell_size_m / std::abs(direction.x());
  const double along_y = params_.cell_size_m / std::abs(direction.y());
  while (inWindow(at)) {
    Cell& cell = cells_[slot(at)];
    if (mayClear(cell.laser)) cell.laser.known = false;
    if (has_echo && cell.at_laser_height && mayClear(cell.points)) cell.points.known = false;
    if (std::min(next_x, next_y) >= length_m) return;
    if (next_x < next_y) {
      at.x += direction.x() > 0.0 ? 1 : -1;
      next_x += along_x;
    } else {
      at.y += direction.y() > 0.0 ? 1 : -1;
      next_y += along_y;
    }
  }
}

void ObstacleLayer::addPoint(const Eigen::Vector3f& point) {
  const double height_m = point.z();
  const Eigen::Vector2d floor = point.head<2>().cast<double>();
  // Also false where a number is not finite.
  if (!(height_m >= params_.min_height_m && height_m <= params_.max_height_m &&
        floor.norm() <= params_.point_range_m)) {
    return;
  }
  const Eigen::Vector2d in_world = T_world_base_ * floor;
  const GridCell at = worldCell(in_world);
  if (!inWindow(at) || leftOut(in_world)) return;
  const std::size_t index = slot(at);
  Cell& cell = cells_[index];
  if (cell.frame_points == 0) {
    touched_.push_back(index);
    cell.frame_at_laser_height = false;
    cell.frame_is_somebody = isSomebody(in_world);
    cell.frame_height_m = point.z();
  }
  cell.frame_height_m = std::max(cell.frame_height_m, point.z());
  if (cell.frame_points < params_.min_points) ++cell.frame_points;
  if (std::abs(height_m - params_.laser_height_m) <= params_.laser_thickness_m) {
    cell.frame_at_laser_height = true;
  }
}

void ObstacleLayer::addPoints(const Eigen::Vector3f* points, std::size_t count) {
  requireFrame();
  std::for_each(points, points + count, [this](const Eigen::Vector3f& p) { addPoint(p); });
}

void ObstacleLayer::addPoints(const std::vector<Eigen::Vector3f>& points) {
  addPoints(points.data(), points.size());
}

void ObstacleLayer::touch(const Eigen::Vector2d& in_base) {
  requireFrame();
  const GridCell at = worldCell(T_world_base_ * in_base);
  if (!inWindow(at)) return;
  cells_[slot(at)].touched_s = clock_s_;
}

void ObstacleLayer::clear(const std::function<bool(const Eigen::Vector3f&)>& sees_through) {
  requireFrame();
  const FloorPose T_base_world = T_world_base_.inverse();
  for (const Eigen::Vector2d& middle : obstacles_) {  // What is newer is not cleared yet.
    const GridCell at = worldCell(middle);
    if (!inWindow(at)) continue;
    Cell& cell = cells_[slot(at)];
    if (!mayClear(cell.points)) continue;
    const Eigen::Vector2f seen = (T_base_world * middle).cast<float>();
    if (sees_through({seen.x(), seen.y(), cell.height_m})) cell.points.known = false;
  }
}

void ObstacleLayer::finish() {
  requireFrame();
  begun_ = false;
  for (const std::size_t i : touched_) {
    Cell& cell = cells_[i];
    if (cell.frame_points >= params_.min_points) {
      const bool again = remembered(cell.points);
      see(cell.points, cell.frame_is_somebody);
      cell.height_m = cell.frame_height_m;
      cell.at_laser_height = cell.frame_at_laser_height || (again && cell.at_laser_height);
    }
    cell.frame_points = 0;
  }
  touched_.clear();

  window_.setOrigin(params_.cell_size_m * Eigen::Vector2d(corner_.x, corner_.y));
  obstacles_.clear();
  steps_.clear();
  // The ring's cell of each window's cell, without a division for each.
  const int n = cells_per_edge_;
  const int first = modulo(corner_.x, n);
  for (int y = 0; y < n; ++y) {
    Cell* const row = &cells_[window_.index({0, modulo(corner_.y + y, n)})];
    for (int x = 0; x < n; ++x) {
      Cell& cell = row[first + x < n ? first + x : first + x - n];
      cell.laser.known = remembered(cell.laser);
      cell.points.known = remembered(cell.points);
      const bool is_touched = clock_s_ - cell.touched_s <= params_.max_memory_s;
      const bool occupied = cell.laser.known || cell.points.known || is_touched;
      const std::size_t at = window_.index({x, y});
      window_.at(GridCell{x, y}) = occupied ? Occupancy::kOccupied : Occupancy::kFree;
      occupied_[at] = occupied ? 1 : 0;
      stood_s_[at] = kNothing_s;
      if (!occupied) continue;
      const bool is_step = cell.points.known && cell.height_m == 0.0F;
      double seen_s = std::max(cell.laser.known ? cell.laser.lasted_s() : 0.0,
                               cell.points.known ? cell.points.lasted_s() : 0.0);
      if (is_touched || is_step) seen_s = std::numeric_limits<double>::infinity();
      stood_s_[at] = static_cast<float>(seen_s);
      obstacles_.push_back(window_.center({x, y}));
      if (is_step) steps_.push_back(obstacles_.back());
    }
  }
  transform_.compute(occupied_, cells_per_edge_, cells_per_edge_, params_.cell_size_m,
                     distances_m_);
}

double ObstacleLayer::distance(const Eigen::Vector2d& point) const {
  const Eigen::Array2d inside = (point - window_.origin_m()) / params_.cell_size_m;
  // Also where it is not a number.
  if (!((inside >= 0.0).all() && (inside < cells_per_edge_).all())) {
    return std::numeric_limits<double>::infinity();
  }
  const GridCell cell{static_cast<int>(inside.x()), static_cast<int>(inside.y())};
  return static_cast<double>(distances_m_[window_.index(cell)]);
}

}  // namespace heel
