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

/// Dijkstra's search on cells with 16 moves (a straight line is at most 2.8 % longer by them), from
/// its seeds outwards until the goal is reached. Every move is exact: the body clears all of it. A
/// cell stands for its middle; in a narrow place whose middle line falls between the cells, for the
/// point of its rim that has the most room. As hardly a move is shorter than a cell, the order
/// among cells whose costs differ by less hardly matters: the queue is a row of lists, threaded
/// through flat memory, and a cell that was finished too early is opened again.
class GridWave {
 public:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  /// @param map  Must outlive this; after a change of its layer call mend().
  GridWave(const ClearanceMap& map, const GridWaveParams& params);

  /// Whether the body can stand on the cell's place.
  bool isFree(int cell) const { return half_price_[index(cell)] < kFar; }
  /// The point that the cell stands for [m].
  Eigen::Vector2d placeOf(int cell) const;

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
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  void run(int goal);
  void open(int cell, float cost, int parent);
  void unlink(int cell);
  void relax(int from, int to, float length);
  bool canMove(int from, int to, float length) const;
  bool measure(int cell);
  void chooseSpot(int cell);
  void spreadFrom(int cell);
  void spreadInto(int cell);
  static int listOf(float cost) { return static_cast<int>(cost); }

  const ClearanceMap* map_;
  int width_, height_;
  double radius_m_;
  float radius_, comfort_, crowding_;  ///< In cells.
  std::vector<float> room_;            ///< Clearance of a cell's place, in cells.
  std::vector<float> half_price_;      ///< Of a cell's length there; infinite where not free.
  std::vector<std::uint8_t> spot_;     ///< Which point the cell stands for; 0 is its middle.
  std::vector<int> spotted_;           ///< Cells that stand for another.
  std::vector<float> cost_;
  std::vector<int> parent_;
  std::vector<std::uint8_t> state_;
  std::vector<std::uint8_t> mark_;    ///< While mending: whether a cell's way back still holds.
  std::vector<int> next_, previous_;  ///< In a cell's list; -1 ends it.
  std::vector<int> lists_;            ///< First open cell of each cost in whole cells.
  int list_ = 0;                      ///< No open cell is in a list before this one.
  std::vector<int> touched_, seeds_, chain_, lost_, broken_;
};

}  // namespace heel
