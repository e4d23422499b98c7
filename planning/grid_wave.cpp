// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "planning/grid_wave.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kRoot2 = 1.41421356F, kRoot5 = 2.23606798F;

struct Move {
  int x, y;
  float length;
};

constexpr Move kMoves[16] = {{1, 0, 1.0F},     {0, 1, 1.0F},     {-1, 0, 1.0F},    {0, -1, 1.0F},
                             {1, 1, kRoot2},   {-1, 1, kRoot2},  {-1, -1, kRoot2}, {1, -1, kRoot2},
                             {2, 1, kRoot5},   {1, 2, kRoot5},   {-1, 2, kRoot5},  {-2, 1, kRoot5},
                             {-2, -1, kRoot5}, {-1, -2, kRoot5}, {1, -2, kRoot5},  {2, -1, kRoot5}};

/// The points that a cell may stand for: its middle and those of its rim, in half cells from it.
constexpr int kSpots[9][2] = {{0, 0}, {1, 0},  {0, 1},   {-1, 0}, {0, -1},
                              {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

constexpr std::uint8_t kUnknownYet = 0, kHolds = 1, kBroken = 2;

}  // namespace

GridWave::GridWave(const ClearanceMap& map, const GridWaveParams& params)
    : map_(&map),
      width_(map.width()),
      height_(map.height()),
      radius_m_(params.radius_m),
      radius_(static_cast<float>(params.radius_m / map.cell_size_m())),
      comfort_(static_cast<float>(params.comfort_m / map.cell_size_m())),
      crowding_(static_cast<float>(params.crowding)) {
  if (!(params.radius_m > 0.0) || !(params.comfort_m > 0.0) || !(params.crowding >= 0.0) ||
      !std::isfinite(params.radius_m + params.comfort_m + params.crowding)) {
    throw std::invalid_argument("a wave's radius and comfort must be positive");
  }
  if (params.radius_m > map.reach_m()) {
    throw std::invalid_argument("a wave's radius must be within the reach of the clearances");
  }
  const auto size = index(width_ * height_);
  next_.assign(size, -1);
  previous_.assign(size, -1);
  lists_.assign(index(2 * (width_ + height_)), -1);
  cost_.assign(size, kFar);
  parent_.assign(size, -1);
  state_.assign(size, kNew);
  mark_.assign(size, kUnknownYet);
  spot_.assign(size, 0);
  room_.assign(size, 0.0F);
  half_price_.assign(size, kFar);
  for (int cell = 0; cell < width_ * height_; ++cell) measure(cell);
}

Eigen::Vector2d GridWave::placeOf(int cell) const {
  const int* spot = kSpots[spot_[index(cell)]];
  return map_->centerOf(cell) + 0.5 * map_->cell_size_m() * Eigen::Vector2d(spot[0], spot[1]);
}

/// Chooses the cell's place and what it costs there.
/// @return  whether anything has changed.
bool GridWave::measure(int cell) {
  const std::size_t i = index(cell);
  const std::uint8_t old_spot = spot_[i];
  const float old_room = room_[i];
  spot_[i] = 0;
  room_[i] = map_->clearanceInCells(cell);
  if (room_[i] < radius_ && room_[i] > radius_ - 0.5F * kRoot2) chooseSpot(cell);
  half_price_[i] = kFar;
  if (room_[i] >= radius_) {
    const float share = (room_[i] - radius_) / comfort_;
    half_price_[i] = 0.5F * (1.0F + crowding_ * std::max(0.0F, 1.0F - share));
  }
  return spot_[i] != old_spot || room_[i] != old_room;
}

/// Looks for a place on the rim, if the cell lies on the middle line of a passage: nowhere else
/// does the search need it.
void GridWave::chooseSpot(int cell) {
  const int x = cell % width_, y = cell / width_;
  if (x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1) return;
  const float here = room_[index(cell)];
  const auto is_ridge = [&](int across) {
    const float a = map_->clearanceInCells(cell - across),
                b = map_->clearanceInCells(cell + across);
    return here >= a && here >= b && here > std::min(a, b);
  };
  if (!is_ridge(1) && !is_ridge(width_) && !is_ridge(width_ + 1) && !is_ridge(width_ - 1)) return;
  const Eigen::Vector2d middle = map_->centerOf(cell);
  for (std::uint8_t k = 1; k < 9; ++k) {
    const Eigen::Vector2d offset(kSpots[k][0], kSpots[k][1]);
    const Eigen::Vector2d place = middle + 0.5 * map_->cell_size_m() * offset;
    const auto room = static_cast<float>(map_->clearance(place) / map_->cell_size_m());
    if (room < radius_ || room <= room_[index(cell)]) continue;
    room_[index(cell)] = room;
    spot_[index(cell)] = k;
  }
  if (spot_[index(cell)] != 0) spotted_.push_back(cell);
}

void GridWave::begin(const std::vector<WaveSeed>& seeds) {
  for (const int cell : touched_) {
    cost_[index(cell)] = kFar;
    state_[index(cell)] = kNew;
  }
  std::fill(lists_.begin(), lists_.end(), -1);
  list_ = 0;
  touched_.clear();
  seeds_.clear();
  for (const WaveSeed& seed : seeds) {
    if (!isFree(seed.cell)) throw std::invalid_argument("a wave must begin on free cells");
    open(seed.cell, seed.cost, -1);
    seeds_.push_back(seed.cell);
  }
}

bool GridWave::reach(int goal) {
  if (isFree(goal)) run(goal);
  return isFree(goal) && cost_[index(goal)] < kFar;
}

void GridWave::reachAll() { run(-1); }

void GridWave::run(int goal) {
  for (; list_ < static_cast<int>(lists_.size()); ++list_) {
    // All that is open costs as much as the list at least.
    if (goal >= 0 && cost_[index(goal)] <= static_cast<float>(list_)) return;
    for (int cell = lists_[index(list_)]; cell >= 0; cell = lists_[index(list_)]) {
      unlink(cell);
      state_[index(cell)] = kDone;
      spreadFrom(cell);
    }
  }
}

void GridWave::open(int cell, float cost, int parent) {
  if (state_[index(cell)] == kOpen) unlink(cell);
  if (cost_[index(cell)] == kFar) touched_.push_back(cell);
  cost_[index(cell)] = cost;
  parent_[index(cell)] = parent;
  state_[index(cell)] = kOpen;
  const int list = listOf(cost);
  if (index(list) >= lists_.size()) lists_.resize(2 * index(list), -1);
  list_ = std::min(list_, list);
  const int first = lists_[index(list)];
  next_[index(cell)] = first;
  previous_[index(cell)] = -1;
  if (first >= 0) previous_[index(first)] = cell;
  lists_[index(list)] = cell;
}

void GridWave::unlink(int cell) {
  const int next = next_[index(cell)], previous = previous_[index(cell)];
  if (next >= 0) previous_[index(next)] = previous;
  (previous >= 0 ? next_[index(previous)] : lists_[index(listOf(cost_[index(cell)]))]) = next;
}

/// Relaxes the moves out of a cell.
void GridWave::spreadFrom(int cell) {
  const int x = cell % width_, y = cell / width_;
  for (const Move& move : kMoves) {
    const int nx = x + move.x, ny = y + move.y;
    if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
    relax(cell, ny * width_ + nx, move.length);
  }
}

/// Relaxes the moves into a cell from finished ones.
void GridWave::spreadInto(int cell) {
  const int x = cell % width_, y = cell / width_;
  for (const Move& move : kMoves) {
    const int nx = x + move.x, ny = y + move.y;
    if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
    const int neighbour = ny * width_ + nx;
    if (state_[index(neighbour)] == kDone) relax(neighbour, cell, move.length);
  }
}

/// Clearance changes by no more than the way: with enough at both ends there is enough between.
bool GridWave::canMove(int from, int to, float length) const {
  const float room = room_[index(from)] + room_[index(to)];
  return room >= 2.0F * radius_ + length || map_->isClear(placeOf(from), placeOf(to), radius_m_);
}

void GridWave::relax(int from, int to, float length) {
  if ((spot_[index(from)] | spot_[index(to)]) != 0) {
    length = static_cast<float>((placeOf(to) - placeOf(from)).norm() / map_->cell_size_m());
  }
  const float price = half_price_[index(from)] + half_price_[index(to)];
  const float cost = cost_[index(from)] + length * price;
  if (cost >= cost_[index(to)] || !canMove(from, to, length)) return;
  open(to, cost, from);
}

bool GridWave::mend(const std::vector<int>& changed) {
  // A point on a rim may have lost its room though the middle of its cell has not.
  broken_.assign(spotted_.begin(), spotted_.end());
  spotted_.clear();
  broken_.insert(broken_.end(), changed.begin(), changed.end());
  for (const int cell : broken_) {
    if (mark_[index(cell)] == kUnknownYet) mark_[index(cell)] = measure(cell) ? kBroken : kHolds;
  }
  for (const int cell : broken_) {
    if (mark_[index(cell)] == kHolds) mark_[index(cell)] = kUnknownYet;
  }
  bool holds = true;
  for (const int cell : seeds_) holds = holds && mark_[index(cell)] != kBroken;

  // A cell's cost holds if nothing has changed on its way back to a seed.
  lost_.clear();
  std::size_t kept = 0;
  for (const int cell : touched_) {
    int at = cell;
    chain_.clear();
    while (at >= 0 && mark_[index(at)] == kUnknownYet) {
      chain_.push_back(at);
      at = parent_[index(at)];
    }
    const std::uint8_t mark = at < 0 ? kHolds : mark_[index(at)];
    for (const int link : chain_) mark_[index(link)] = mark;
    if (mark_[index(cell)] == kHolds) {
      touched_[kept++] = cell;
    } else {
      lost_.push_back(cell);
    }
  }
  touched_.resize(kept);
  for (const int cell : touched_) mark_[index(cell)] = kUnknownYet;
  for (const int cell : lost_) {
    mark_[index(cell)] = kUnknownYet;
    if (state_[index(cell)] == kOpen) unlink(cell);
    cost_[index(cell)] = kFar;
    state_[index(cell)] = kNew;
  }
  for (const int cell : broken_) mark_[index(cell)] = kUnknownYet;
  if (!holds) return false;
  for (const int cell : lost_) {
    if (isFree(cell)) spreadInto(cell);
  }
  for (const int cell : broken_) {
    if (isFree(cell)) spreadInto(cell);
  }
  return true;
}

}  // namespace heel
