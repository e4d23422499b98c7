// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/map_drawing.hpp>

#include <cstdint>
#include <vector>

namespace heel {
namespace {

/// Walks along the edges of an area, with the area on the left hand.
class OutlineWalk {
 public:
  OutlineWalk(const OccupancyGrid& grid, Occupancy what)
      : grid_(grid),
        what_(what),
        walked_(static_cast<std::size_t>(grid.width() + 1) *
                static_cast<std::size_t>(grid.height() + 1)) {}

  /// Whether the lower side of the cell is an edge that was not walked yet.
  bool isStart(const GridCell& cell) const {
    return isIn(cell.x, cell.y) && !isIn(cell.x, cell.y - 1) && !walked_[node(cell.x, cell.y)];
  }

  /// The corners of the edge's loop, in whole cells, from the cell's lower left one on.
  std::vector<GridCell> loopFrom(const GridCell& start) {
    std::vector<GridCell> corners;
    GridCell at = start;
    int heading = 0;  // to the right, up, left, down
    do {
      if (heading == 0) walked_[node(at.x, at.y)] = 1;
      at = {at.x + kStep[heading].x, at.y + kStep[heading].y};
      const int turned = nextHeading(at, heading);
      if (turned != heading) corners.push_back(at);
      heading = turned;
    } while (!(at == start && heading == 0));
    return corners;
  }

 private:
  static constexpr GridCell kStep[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

  bool isIn(int x, int y) const {
    return grid_.contains(GridCell{x, y}) && grid_.at(GridCell{x, y}) == what_;
  }
  std::size_t node(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width() + 1) +
           static_cast<std::size_t>(x);
  }

  /// The cell ahead of a corner, on the left or right hand of the heading.
  bool isInAhead(const GridCell& at, int heading, bool left) const {
    static constexpr GridCell kQuadrant[4] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}};
    const GridCell q = kQuadrant[(heading + (left ? 0 : 3)) % 4];
    return isIn(at.x + q.x, at.y + q.y);
  }

  /// Cells that touch at a corner only are walked around one by one.
  int nextHeading(const GridCell& at, int heading) const {
    if (!isInAhead(at, heading, true)) return (heading + 1) % 4;
    return isInAhead(at, heading, false) ? (heading + 3) % 4 : heading;
  }

  const OccupancyGrid& grid_;
  Occupancy what_;
  std::vector<std::uint8_t> walked_;  ///< By the edge that goes to the right from a corner.
};

}  // namespace

Eigen::AlignedBox2d occupiedBounds(const OccupancyGrid& grid) {
  Eigen::AlignedBox2d bounds;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(grid.cell_size_m() / 2);
  for (GridCell cell; cell.y < grid.height(); ++cell.y) {
    for (cell.x = 0; cell.x < grid.width(); ++cell.x) {
      if (grid.at(cell) != Occupancy::kOccupied) continue;
      bounds.extend(grid.center(cell) - half).extend(grid.center(cell) + half);
    }
  }
  return bounds;
}

std::string outlinePath(const OccupancyGrid& grid, Occupancy what,
                        const Eigen::Vector2d& top_left_m) {
  std::string path;
  OutlineWalk walk(grid, what);
  const auto x = [&](const GridCell& c) {
    return fixedText(grid.origin_m().x() + c.x * grid.cell_size_m() - top_left_m.x(), 2);
  };
  const auto y = [&](const GridCell& c) {
    return fixedText(top_left_m.y() - grid.origin_m().y() - c.y * grid.cell_size_m(), 2);
  };
  for (GridCell cell; cell.y < grid.height(); ++cell.y) {
    for (cell.x = 0; cell.x < grid.width(); ++cell.x) {
      if (!walk.isStart(cell)) continue;
      const std::vector<GridCell> corners = walk.loopFrom(cell);
      // Runs are across and along in turn.
      path += 'M' + x(corners[0]) + ' ' + y(corners[0]);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        path += corners[i].x == corners[i - 1].x ? 'V' + y(corners[i]) : 'H' + x(corners[i]);
      }
      path += 'Z';
    }
  }
  return path;
}

}  // namespace heel
