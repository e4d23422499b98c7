// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/grid_wave.hpp>

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

constexpr int kMostStride = 7;
/// The move that leads back: they are in groups of four quarter turns, the last two alternate.
unsigned opposite(unsigned move) { return move < 8 ? move ^ 2U : move ^ 4U; }

/// Moves that turn by at most a right angle from a move; the rest lead back to where the way came
/// by.
std::array<unsigned, 16> movesOnward() {
  std::array<unsigned, 16> onward{};
  for (unsigned k = 0; k < 256; ++k) {
    const Move &a = kMoves[k / 16], &b = kMoves[k % 16];
    if (a.x * b.x + a.y * b.y >= 0) onward[k / 16] |= 1U << k % 16;
  }
  return onward;
}

/// What is to go counts for more than it is: costs come out greater by up to this, hardly ever are,
/// and far fewer cells are looked at.
constexpr float kHaste = 1.06F;

constexpr unsigned kAllMoves = 0xFFFF;

}  // namespace

GridWave::GridWave(const ClearanceMap& map, const GridWaveParams& params)
    : map_(&map),
      stride_(params.stride),
      width_((map.width() + stride_ - 1) / std::max(1, stride_)),
      height_((map.height() + stride_ - 1) / std::max(1, stride_)),
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
  if (stride_ < 1 || stride_ > kMostStride) {
    throw std::invalid_argument("a wave's stride must be from 1 to 7");
  }
  cells_.resize(index(width_ * height_));
  lists_.assign(index(2 * (width_ + height_)), -1);
  std::transform(std::begin(kMoves), std::end(kMoves), steps_.begin(),
                 [&](const Move& move) { return move.y * width_ + move.x; });
  for (int cell = 0; cell < width_ * height_; ++cell) {
    measure(cell);
    forgetMoves(cell);
  }
}

int GridWave::cellOfMaps(int map_cell) const {
  const int x = map_cell % map_->width(), y = map_cell / map_->width();
  return y / stride_ * width_ + x / stride_;
}

/// No move leads off the map; that is always known.
void GridWave::forgetMoves(int cell) {
  const int x = cell % width_, y = cell / width_;
  unsigned known = 0;
  if (x < 2 || y < 2 || x >= width_ - 2 || y >= height_ - 2) {
    for (unsigned k = 0; k < 16; ++k) {
      const int nx = x + kMoves[k].x, ny = y + kMoves[k].y;
      if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) known |= 1U << k;
    }
  }
  at(cell).known = static_cast<std::uint16_t>(known);
  at(cell).clear = 0;
}

/// What a move sweeps has come near to, or gone from, a point of the move: that is near by.
void GridWave::forgetMovesAround(int cell) {
  const int x0 = cell % width_, y0 = cell / width_;
  for (int y = std::max(0, y0 - 2); y <= std::min(height_ - 1, y0 + 2); ++y) {
    for (int x = std::max(0, x0 - 2); x <= std::min(width_ - 1, x0 + 2); ++x) {
      forgetMoves(y * width_ + x);
    }
  }
}

void GridWave::learnMoves() {
  for (int cell = 0; cell < width_ * height_; ++cell) {
    if (!isFree(cell)) continue;
    for (unsigned k = 0; k < 16; ++k) canMove(cell, k);
  }
}

void GridWave::begin(const std::vector<WaveSeed>& seeds) {
  for (const int cell : touched_) {
    at(cell).cost = kFar;
    at(cell).state = kNew;
  }
  std::fill(lists_.begin(), lists_.end(), -1);
  list_ = 0;
  last_list_ = -1;
  heads_for_goal_ = false;
  touched_.clear();
  seeds_.clear();
  for (const WaveSeed& seed : seeds) {
    if (!isFree(seed.cell)) throw std::invalid_argument("a wave must begin on free cells");
    at(seed.cell).by = kNoMove;
    open(seed.cell, seed.cost, -1);
    seeds_.push_back(seed.cell);
  }
}

void GridWave::headFor(const Eigen::Vector2d& goal) {
  const Eigen::Vector2d halves = (goal - map_->centerOf(0)) * (2.0 / map_->cell_size_m());
  const Place place = {static_cast<int>(std::lround(halves.x())) + 1,
                       static_cast<int>(std::lround(halves.y())) + 1};
  if (heads_for_goal_ && place.x == goal_.x && place.y == goal_.y) return;
  heads_for_goal_ = true;
  goal_ = place;
  open_.clear();
  for (; list_ <= last_list_; ++list_) {
    for (int cell = lists_[index(list_)]; cell >= 0; cell = at(cell).next) {
      open_.push_back(cell);
    }
    lists_[index(list_)] = -1;
  }
  list_ = static_cast<int>(lists_.size());
  last_list_ = -1;
  for (const int cell : open_) link(cell);
}

/// By the 16 moves, if nothing is in the way; with haste.
float GridWave::toGo(int cell) const {
  if (!heads_for_goal_) return 0.0F;
  const int dx = std::abs(at(cell).place.x - goal_.x);
  const int dy = std::abs(at(cell).place.y - goal_.y);
  const auto more = static_cast<float>(std::max(dx, dy));
  const auto less = static_cast<float>(std::min(dx, dy));
  return 0.5F * kHaste *
         std::max(more + (kRoot5 - 2.0F) * less,
                  (kRoot5 - kRoot2) * more + (2.0F * kRoot2 - kRoot5) * less);
}

bool GridWave::reach(int cell) {
  if (!isFree(cell)) return false;
  run(cell);
  return at(cell).cost < kFar;
}

void GridWave::run(int until) {
  for (; list_ <= last_list_; ++list_) {
    // Whatever way goes through what is open costs as much as the list at least.
    if (at(until).cost + toGo(until) <= static_cast<float>(list_)) return;
    for (int cell = lists_[index(list_)]; cell >= 0; cell = lists_[index(list_)]) {
      unlink(cell);
      at(cell).state = kDone;
      spreadFrom(cell);
    }
  }
}

void GridWave::open(int cell, float cost, int parent) {
  if (at(cell).state == kOpen) unlink(cell);
  if (at(cell).cost == kFar) touched_.push_back(cell);
  at(cell).cost = cost;
  at(cell).parent = parent;
  at(cell).state = kOpen;
  link(cell);
}

/// Puts a cell in its list.
void GridWave::link(int cell) {
  const int list = static_cast<int>(at(cell).cost + toGo(cell));
  if (index(list) >= lists_.size()) lists_.resize(2 * index(list), -1);
  at(cell).list = list;
  list_ = std::min(list_, list);
  last_list_ = std::max(last_list_, list);
  const int first = lists_[index(list)];
  at(cell).next = first;
  at(cell).previous = -1;
  if (first >= 0) at(first).previous = cell;
  lists_[index(list)] = cell;
}

void GridWave::unlink(int cell) {
  const int next = at(cell).next, previous = at(cell).previous;
  if (next >= 0) at(next).previous = previous;
  (previous >= 0 ? at(previous).next : lists_[index(at(cell).list)]) = next;
}

/// Relaxes the moves out of a cell.
void GridWave::spreadFrom(int cell) {
  static const std::array<unsigned, 16> kOnward = movesOnward();
  const unsigned shut = at(cell).known & ~unsigned{at(cell).clear};
  const std::uint8_t by = at(cell).by;
  for (unsigned moves = (by != kNoMove ? kOnward[by] : kAllMoves) & ~shut; moves != 0;
       moves &= moves - 1) {
    relax(cell, static_cast<unsigned>(__builtin_ctz(moves)));
  }
}

/// Relaxes the moves into a cell from finished ones.
void GridWave::spreadInto(int cell) {
  const unsigned shut = at(cell).known & ~unsigned{at(cell).clear};
  for (unsigned k = 0; k < 16; ++k) {
    const int from = cell + steps_[k];
    if ((shut >> k & 1U) == 0 && at(from).state == kDone) relax(from, opposite(k));
  }
}

/// Whether the body clears a move. Clearance changes by no more than the way: with enough at both
/// ends there is enough between.
bool GridWave::canMove(int from, unsigned move) {
  Cell& cell = at(from);
  const auto bit = static_cast<std::uint16_t>(1U << move);
  if ((cell.known & bit) == 0) {
    cell.known = static_cast<std::uint16_t>(cell.known | bit);
    const int to = from + steps_[move];
    const bool has_room = cell.room + at(to).room >= 2.0F * radius_ + lengthOf(from, to);
    if (isFree(to) && (has_room || map_->isClear(placeOf(from), placeOf(to), radius_m_))) {
      cell.clear = static_cast<std::uint16_t>(cell.clear | bit);
    }
  }
  return (cell.clear & bit) != 0;
}

float GridWave::lengthOf(int from, int to) const {
  const Place a = at(from).place, b = at(to).place;
  const int dx = b.x - a.x, dy = b.y - a.y;
  return 0.5F * std::sqrt(static_cast<float>(dx * dx + dy * dy));
}

void GridWave::relax(int from, unsigned move) {
  const int to = from + steps_[move];
  const float price = at(from).half_price + at(to).half_price;
  const float cost = at(from).cost + lengthOf(from, to) * price;
  if (cost < at(to).cost && canMove(from, move)) {
    at(to).by = static_cast<std::uint8_t>(move);
    open(to, cost, from);
  }
}

bool GridWave::mend(const std::vector<int>& changed) {
  // A point on a rim may have lost its room though the middle of its cell has not.
  broken_.assign(rimmed_.begin(), rimmed_.end());
  rimmed_.clear();
  for (const int map_cell : changed) broken_.push_back(cellOfMaps(map_cell));
  for (const int cell : broken_) {
    if (at(cell).mark != kUnknownYet) continue;
    at(cell).mark = measure(cell) ? kBroken : kHolds;
    forgetMovesAround(cell);
  }
  for (const int cell : broken_) {
    if (at(cell).mark == kHolds) at(cell).mark = kUnknownYet;
  }
  bool holds = true;
  for (const int cell : seeds_) holds = holds && at(cell).mark != kBroken;

  // A cell's cost holds if nothing has changed on its way back to a seed.
  lost_.clear();
  std::size_t kept = 0;
  for (const int cell : touched_) {
    int way = cell;
    chain_.clear();
    while (way >= 0 && at(way).mark == kUnknownYet) {
      chain_.push_back(way);
      way = at(way).parent;
    }
    const Mark mark = way < 0 ? kHolds : at(way).mark;
    for (const int link : chain_) at(link).mark = mark;
    if (at(cell).mark == kHolds) {
      touched_[kept++] = cell;
    } else {
      lost_.push_back(cell);
    }
  }
  touched_.resize(kept);
  for (const int cell : touched_) at(cell).mark = kUnknownYet;
  for (const int cell : lost_) {
    at(cell).mark = kUnknownYet;
    if (at(cell).state == kOpen) unlink(cell);
    at(cell).cost = kFar;
    at(cell).state = kNew;
  }
  for (const int cell : broken_) at(cell).mark = kUnknownYet;
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
