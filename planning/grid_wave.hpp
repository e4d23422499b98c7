// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A wave of least costs over the free cells of a map, which is kept: it goes on where it stopped
/// when the goal moves, and mends itself where the map changes.
#pragma once

#include <heel/planning/clearance_map.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace heel {

/// What a wave goes through.
struct GridWaveParams {
  int stride = 1;          ///< How many of the map's cells one cell of the wave is wide; up to 7.
  double radius_m = 0.3;   ///< Radius of the body, with its safety.
  double comfort_m = 0.2;  ///< Cells with less room than this beyond the radius cost more.
  double crowding = 0.0;   ///< A cell without comfort_m counts as longer, by up to this share.
};

/// Where a wave begins.
struct WaveSeed {
  int cell = 0;
  float cost = 0.0F;  ///< In the map's cells.
};

/// A search (Dijkstra's, or A* towards a goal) on cells with 16 moves (a straight line is at
/// most 2.8 % longer by them), from its seeds outwards until the goal is reached. Every move is
/// exact: the body clears all of it, which is found out once. A cell stands for its middle; where
/// the body can't stand there, for the middle of that of the map's cells in it which has the most
/// room, and in a narrow place whose middle line falls between the map's cells, for the point on a
/// rim that has the most room. As hardly a move is shorter than a cell, the order among cells whose
/// costs differ by less hardly matters: the queue is a row of lists, threaded through flat memory,
/// and a cell that was finished too early is opened again.
class GridWave {
 public:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  /// @param map  Must outlive this; after a change of its layer call mend().
  /// @throws std::invalid_argument  if a parameter is out of its range.
  GridWave(const ClearanceMap& map, const GridWaveParams& params);

  int width() const { return width_; }
  int height() const { return height_; }
  double cell_size_m() const { return stride_ * map_->cell_size_m(); }
  /// Index of the cell that holds a point which is on the map.
  int cellOf(const Eigen::Vector2d& point) const { return cellOfMaps(map_->cellOf(point)); }
  /// Whether the body can stand on the cell's place.
  bool isFree(int cell) const { return at(cell).half_price < kFar; }
  /// The point that the cell stands for [m].
  Eigen::Vector2d placeOf(int cell) const;

  /// Finds out about all moves at once, which searches then need not do.
  void learnMoves();
  /// Forgets everything and begins at the seeds.
  /// @throws std::invalid_argument  if a seed is not free.
  void begin(const std::vector<WaveSeed>& seeds);
  /// From now on, looks first where the way to this point is short (A*), and takes 6 % longer ways
  /// for as good; until begin().
  void headFor(const Eigen::Vector2d& goal);
  /// Goes on until the least cost of a cell is known, or another's of as short a way to the goal.
  /// @return  false if it can't be reached.
  bool reach(int cell);
  /// Takes in that the clearance of these cells of the map has changed.
  /// @return  false if that concerns a seed, then it must begin anew.
  bool mend(const std::vector<int>& changed);

  /// Least cost of a cell that was reached, in the map's cells; else an upper bound or kFar.
  float cost(int cell) const { return at(cell).cost; }
  /// The cell before this one; -1 for a seed.
  int parent(int cell) const { return at(cell).parent; }

 private:
  /// A point in halves of the map's cells, from its lower corner.
  struct Place {
    int x, y;
  };
  enum State : std::uint8_t { kNew, kOpen, kDone };
  enum Mark : std::uint8_t { kUnknownYet, kHolds, kBroken };
  static constexpr std::uint8_t kNoMove = 16;
  /// All of a cell is used together, so it lies together.
  struct Cell {
    Place place{0, 0};        ///< Which point the cell stands for.
    float room = 0.0F;        ///< Clearance there, in the map's cells.
    float half_price = kFar;  ///< Of a cell's length there; infinite where not free.
    std::uint16_t known = 0;  ///< A bit for each move, whether it is known if ...
    std::uint16_t clear = 0;  ///< ... the body can make it.
    float cost = kFar;
    int parent = -1;
    int next = -1, previous = -1;  ///< In its list; -1 ends it.
    int list = 0;                  ///< Which an open cell is in.
    State state = kNew;
    Mark mark = kUnknownYet;    ///< While mending: whether the way back still holds.
    std::uint8_t by = kNoMove;  ///< The move that it was reached by.
  };
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }
  Cell& at(int cell) { return cells_[index(cell)]; }
  const Cell& at(int cell) const { return cells_[index(cell)]; }
  void run(int until);
  void open(int cell, float cost, int parent);
  void link(int cell);
  void unlink(int cell);
  void relax(int from, unsigned move);
  bool canMove(int from, unsigned move);
  float lengthOf(int from, int to) const;
  float toGo(int cell) const;
  bool measure(int index);
  void choosePlace(int cell);
  void chooseRim(int cell, int x, int y);
  int cellOfMaps(int map_cell) const;
  void forgetMoves(int cell);
  void forgetMovesAround(int cell);
  void spreadFrom(int cell);
  void spreadInto(int cell);

  const ClearanceMap* map_;
  int stride_;
  int width_, height_;
  std::array<int, 16> steps_;  ///< From a cell to the next of each move.
  double radius_m_;
  float radius_, comfort_, crowding_;  ///< In the map's cells.
  std::vector<Cell> cells_;
  std::vector<int> rimmed_;  ///< Cells that stand for a point on a rim.
  bool heads_for_goal_ = false;
  Place goal_{0, 0};
  std::vector<int> lists_;  ///< First open cell of each cost, with what is to go, in whole cells.
  int list_ = 0;            ///< No open cell is in a list before this one ...
  int last_list_ = -1;      ///< ... nor after this one.
  std::vector<int> touched_, seeds_, chain_, lost_, broken_, open_;
};

/// Free cells of the wave whose place is within `within_m` of the
/// point, the nearest first.
void freeCellsNear(const ClearanceMap& map, const GridWave& wave, const Eigen::Vector2d& point,
                   double within_m, std::vector<int>& cells);

}  // namespace heel
