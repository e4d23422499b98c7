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
  cost_.assign(size, kFar);
  parent_.assign(size, -1);
  state_.assign(size, kNew);
  mark_.assign(size, kUnknownYet);
}

void GridWave::begin(const std::vector<WaveSeed>& seeds) {
  for (const int cell : touched_) {
    cost_[index(cell)] = kFar;
    state_[index(cell)] = kNew;
  }
  touched_.clear();
  heap_.clear();
  seeds_.clear();
  goal_ = -1;
  for (const WaveSeed& seed : seeds) {
    if (!isFree(seed.cell)) throw std::invalid_argument("a wave must begin on free cells");
    cost_[index(seed.cell)] = seed.cost;
    parent_[index(seed.cell)] = -1;
    state_[index(seed.cell)] = kOpen;
    touched_.push_back(seed.cell);
    seeds_.push_back(seed.cell);
    heap_.push_back({seed.cost, seed.cost, seed.cell});
  }
  std::make_heap(heap_.begin(), heap_.end());
}

/// Cost so far and the length of the shortest moves to the goal, if nothing is in the way.
float GridWave::bound(int cell) const {
  if (goal_ < 0) return cost_[index(cell)];
  const int dx = std::abs(cell % width_ - goal_x_), dy = std::abs(cell / width_ - goal_y_);
  const auto most = static_cast<float>(std::max(dx, dy)),
             least = static_cast<float>(std::min(dx, dy));
  const float rest = most >= 2.0F * least
                         ? most - 2.0F * least + kRoot5 * least
                         : kRoot5 * (most - least) + kRoot2 * (2.0F * least - most);
  return cost_[index(cell)] + rest;
}

void GridWave::aimAt(int goal) {
  if (goal == goal_) return;
  goal_ = goal;
  if (goal >= 0) {
    goal_x_ = goal % width_;
    goal_y_ = goal / width_;
  }
  std::size_t kept = 0;
  for (const Entry& entry : heap_) {
    if (state_[index(entry.cell)] != kOpen || entry.cost != cost_[index(entry.cell)]) continue;
    heap_[kept++] = {bound(entry.cell), entry.cost, entry.cell};
  }
  heap_.resize(kept);
  std::make_heap(heap_.begin(), heap_.end());
}

bool GridWave::reach(int goal) {
  if (!isFree(goal)) return false;
  aimAt(goal);
  run();
  return cost_[index(goal)] < kFar;
}

void GridWave::reachAll() {
  aimAt(-1);
  run();
}

void GridWave::run() {
  while (!heap_.empty()) {
    const Entry top = heap_.front();
    if (goal_ >= 0 && top.bound >= cost_[index(goal_)]) return;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    if (state_[index(top.cell)] != kOpen || top.cost != cost_[index(top.cell)]) continue;
    state_[index(top.cell)] = kDone;
    spreadFrom(top.cell, false);
  }
}

/// Relaxes the moves out of a cell, or those from finished cells into it.
void GridWave::spreadFrom(int cell, bool only_into_it) {
  const int x = cell % width_, y = cell / width_;
  for (const Move& move : kMoves) {
    const int nx = x + move.x, ny = y + move.y;
    if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
    const int neighbour = ny * width_ + nx;
    if (!only_into_it) {
      relax(cell, neighbour, move.length);
    } else if (state_[index(neighbour)] == kDone) {
      relax(neighbour, cell, move.length);
    }
  }
}

float GridWave::crowdingAt(int cell) const {
  const float room = (map_->clearanceInCells(cell) - radius_) / comfort_;
  return crowding_ * std::max(0.0F, 1.0F - room);
}

/// Clearance changes by no more than the way: with enough at both ends there is enough between.
bool GridWave::canMove(int from, int to, float length) const {
  const float room = map_->clearanceInCells(from) + map_->clearanceInCells(to);
  return room >= 2.0F * radius_ + length ||
         map_->isClear(map_->centerOf(from), map_->centerOf(to), radius_m_);
}

void GridWave::relax(int from, int to, float length) {
  if (!isFree(to)) return;
  float cost = cost_[index(from)];
  if (cost + length >= cost_[index(to)]) return;
  cost += length * (1.0F + 0.5F * (crowdingAt(from) + crowdingAt(to)));
  if (cost >= cost_[index(to)] || !canMove(from, to, length)) return;
  if (cost_[index(to)] == kFar) touched_.push_back(to);
  cost_[index(to)] = cost;
  parent_[index(to)] = from;
  state_[index(to)] = kOpen;
  heap_.push_back({bound(to), cost, to});
  std::push_heap(heap_.begin(), heap_.end());
}

bool GridWave::mend(const std::vector<int>& changed) {
  for (const int cell : changed) mark_[index(cell)] = kBroken;
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
    cost_[index(cell)] = kFar;
    state_[index(cell)] = kNew;
  }
  for (const int cell : changed) mark_[index(cell)] = kUnknownYet;
  if (!holds) return false;
  for (const int cell : lost_) {
    if (isFree(cell)) spreadFrom(cell, true);
  }
  for (const int cell : changed) {
    if (isFree(cell)) spreadFrom(cell, true);
  }
  return true;
}

}  // namespace heel
