// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which points the cells of a wave stand for.

#include <heel/planning/grid_wave.hpp>

#include <algorithm>

namespace heel {
namespace {

constexpr float kDiagonal = 1.41421356F;

/// A wide cell stands for its middle if there is so much more room than it takes, in cells.
constexpr float kAmple = 0.5F;

/// The points on the rim of one of the map's cells, in half cells from its middle.
constexpr int kRim[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

}  // namespace

Eigen::Vector2d GridWave::placeOf(int cell) const {
  const Place place = at(cell).place;
  return map_->centerOf(0) + 0.5 * map_->cell_size_m() * Eigen::Vector2d(place.x - 1, place.y - 1);
}

/// Chooses the cell's place and what it costs there.
/// @return  whether anything has changed.
bool GridWave::measure(int index) {
  Cell& cell = at(index);
  const Place old = cell.place;
  const float old_room = cell.room;
  choosePlace(index);
  cell.half_price = kFar;
  if (cell.room >= radius_) {
    const float share = (cell.room - radius_) / comfort_;
    cell.half_price = 0.5F * (1.0F + crowding_ * std::max(0.0F, 1.0F - share));
  }
  return old.x != cell.place.x || old.y != cell.place.y || cell.room != old_room;
}

void GridWave::choosePlace(int cell) {
  Cell& chosen = at(cell);
  const int x0 = stride_ * (cell % width_), x1 = std::min(x0 + stride_, map_->width());
  const int y0 = stride_ * (cell / width_), y1 = std::min(y0 + stride_, map_->height());
  const auto room = [&](int x, int y) { return map_->clearanceInCells(y * map_->width() + x); };
  const int middle_x = std::min(x0 + stride_ / 2, x1 - 1);
  const int middle_y = std::min(y0 + stride_ / 2, y1 - 1);
  chosen.place = {2 * middle_x + 1, 2 * middle_y + 1};
  chosen.room = room(middle_x, middle_y);
  const float ample = radius_ + (stride_ > 1 ? kAmple : 0.0F);
  if (chosen.room >= ample) return;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      if (room(x, y) <= chosen.room) continue;
      chosen.room = room(x, y);
      chosen.place = {2 * x + 1, 2 * y + 1};
    }
  }
  if (chosen.room >= ample || chosen.room <= radius_ - 0.5F * kDiagonal) return;
  for (int y = std::max(1, y0); y < std::min(y1, map_->height() - 1); ++y) {
    for (int x = std::max(1, x0); x < std::min(x1, map_->width() - 1); ++x) chooseRim(cell, x, y);
  }
  if (chosen.place.x % 2 == 0 || chosen.place.y % 2 == 0) rimmed_.push_back(cell);
}

/// Looks for a place on the rim of one of the map's cells, if that lies on the middle line of a
/// passage: nowhere else does the search need it.
void GridWave::chooseRim(int cell, int x, int y) {
  const int across_y = map_->width(), map_cell = y * across_y + x;
  const float here = map_->clearanceInCells(map_cell);
  if (here <= radius_ - 0.5F * kDiagonal) return;
  const auto is_ridge = [&](int across) {
    const float a = map_->clearanceInCells(map_cell - across),
                b = map_->clearanceInCells(map_cell + across);
    return here >= a && here >= b && here > std::min(a, b);
  };
  if (!is_ridge(1) && !is_ridge(across_y) && !is_ridge(across_y + 1) && !is_ridge(across_y - 1)) {
    return;
  }
  const Eigen::Vector2d middle = map_->centerOf(map_cell);
  for (const auto& rim : kRim) {
    const Eigen::Vector2d place =
        middle + 0.5 * map_->cell_size_m() * Eigen::Vector2d(rim[0], rim[1]);
    const auto room = static_cast<float>(map_->clearance(place) / map_->cell_size_m());
    if (room < radius_ || room <= at(cell).room) continue;
    at(cell).room = room;
    at(cell).place = {2 * x + 1 + rim[0], 2 * y + 1 + rim[1]};
  }
}

void freeCellsNear(const ClearanceMap& map, const GridWave& wave, const Eigen::Vector2d& point,
                   double within_m, std::vector<int>& cells) {
  cells.clear();
  if (!map.isInside(point)) return;
  const int middle = wave.cellOf(point), width = wave.width();
  const int reach = static_cast<int>(std::min(within_m / wave.cell_size_m() + 1.0, 1e6));
  const int mx = middle % width, my = middle / width;
  const auto distance = [&](int cell) { return (wave.placeOf(cell) - point).squaredNorm(); };
  for (int y = std::max(0, my - reach); y <= std::min(wave.height() - 1, my + reach); ++y) {
    for (int x = std::max(0, mx - reach); x <= std::min(width - 1, mx + reach); ++x) {
      const int cell = y * width + x;
      if (wave.isFree(cell) && distance(cell) <= within_m * within_m) cells.push_back(cell);
    }
  }
  std::sort(cells.begin(), cells.end(), [&](int a, int b) {
    const double da = distance(a), db = distance(b);
    return da < db || (da == db && a < b);
  });
}

}  // namespace heel
