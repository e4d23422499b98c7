// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A wave of least costs over the free cells of a map, which is kept: it goes on where it stopped
/// when the goal moves, and mends itself where the map changes.
#pragma once

#include "planning/clearance_map.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace heel {

/// What a wave goes through.
struct GridWaveParams {
  double radius_m = 0.3;   ///< Of the body, with its safety.
  double comfort_m = 0.2;  ///< Cells with less room than this beyond the radius cost more ...
  double crowding = 0.0;   ///< ... by up to this share of their length.
};

/// Where a wave begins.
struct WaveSeed {
  int cell = 0;
  float cost = 0.0F;  ///< In cells.
};

/// A* on cells' middles with 16 moves (a straight line is at most 2.8 % longer by them), from its
/// seeds to any goal. The costs of finished cells are least costs whatever goal they were found
/// for, so a new goal only needs the open ones sorted anew. Every move is exact: the body clears
/// all of it. Memory is flat and reused.
class GridWave {
 public:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  /// @param map  Must outlive this; after a change of its layer call mend().
  GridWave(const ClearanceMap& map, const GridWaveParams& params);

  /// Whether the body can stand on the cell's middle.
  bool isFree(int cell) const { return map_->clearanceInCells(cell) >= radius_; }

  /// Forgets everything and begins at the seeds, which must be free.
  void begin(const std::vector<WaveSeed>& seeds);
  /// Goes on until the least cost of `goal` is known.
  /// @return  false if it can't be reached.
  bool reach(int goal);
  /// Goes on to all that can be reached.
  void reachAll();
  /// Takes in that the clearance of these cells has changed.
  /// @return  false if that concerns a seed, then it must begin anew.
  bool mend(const std::vector<int>& changed);

  /// Least cost of a cell that was reached, in cells; else an upper bound or kFar.
  float cost(int cell) const { return cost_[index(cell)]; }
  /// The cell before this one; -1 for a seed.
  int parent(int cell) const { return parent_[index(cell)]; }
  /// Cells that have a cost.
  const std::vector<int>& touched() const { return touched_; }

 private:
  enum State : std::uint8_t { kNew, kOpen, kDone };
  struct Entry {
    float bound;  ///< Of a whole path through here.
    float cost;
    int cell;
    friend bool operator<(const Entry& a, const Entry& b) {  // For a heap with the least on top.
      return a.bound > b.bound || (a.bound == b.bound && a.cell > b.cell);
    }
  };
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  float bound(int cell) const;
  void aimAt(int goal);
  void run();
  void relax(int from, int to, float length);
  bool canMove(int from, int to, float length) const;
  float crowdingAt(int cell) const;
  void spreadFrom(int cell, bool only_into_it);

  const ClearanceMap* map_;
  int width_, height_;
  double radius_m_;
  float radius_, comfort_, crowding_;  ///< In cells.
  std::vector<float> cost_;
  std::vector<int> parent_;
  std::vector<std::uint8_t> state_;
  std::vector<std::uint8_t> mark_;  ///< While mending: whether a cell's way back still holds.
  std::vector<Entry> heap_;
  std::vector<int> touched_, seeds_, chain_, lost_;
  int goal_ = -1, goal_x_ = 0, goal_y_ = 0;  ///< -1: everywhere.
};

}  // namespace heel
