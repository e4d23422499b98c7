// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/map_picture.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

constexpr int kMargin_px = 16;
constexpr int kHeader_px = 40;
constexpr int kFooter_px = 36;
constexpr int kLeastWidth_px = 420;  // So that the texts have room.

cv::Vec3b pixelOf(Occupancy cell) {
  const cv::Scalar& color = cell == Occupancy::kOccupied ? palette::kInk
                            : cell == Occupancy::kFree   ? palette::kPanelLit
                                                         : palette::kPaper;
  return {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
          static_cast<std::uint8_t>(color[2])};
}

/// A whole number of metres (1, 2, 5, 10, ...) that is about a fifth of the width.
int scaleLength_m(double width_m) {
  int length = 1;
  for (const int step : {2, 5, 10, 20, 50, 100, 200, 500}) {
    if (step <= width_m / 4.0) length = step;
  }
  return length;
}

void drawScale(cv::Mat& picture, const OccupancyGrid& grid, double pixels_per_m) {
  const int length_m = scaleLength_m(grid.cell_size_m() * grid.width());
  const double row = picture.rows - kFooter_px / 2.0;
  const cv::Point2d from(kMargin_px, row), to(kMargin_px + length_m * pixels_per_m, row);
  drawLine(picture, from, to, palette::kInkSoft, 2);
  for (const cv::Point2d& end : {from, to}) {
    drawLine(picture, end - cv::Point2d(0, 4), end + cv::Point2d(0, 4), palette::kInkSoft, 2);
  }
  drawText(picture, std::to_string(length_m) + " m",
           {static_cast<int>(to.x) + 10, static_cast<int>(row)}, palette::kInkSoft);
}

}  // namespace

cv::Mat drawMap(const OccupancyGrid& grid, const std::string& title, int size_px) {
  if (grid.empty()) throw std::invalid_argument("drawMap: the grid is empty");
  cv::Mat cells(grid.height(), grid.width(), CV_8UC3);
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      cells.at<cv::Vec3b>(grid.height() - 1 - y, x) = pixelOf(grid.at(GridCell{x, y}));
    }
  }
  // Whole pixels a cell while there is room; else areas are averaged, so that no wall is lost.
  double scale = static_cast<double>(size_px) / std::max(grid.width(), grid.height());
  if (scale > 1.0) scale = std::floor(scale);
  cv::Mat plan;
  cv::resize(cells, plan, {}, scale, scale, scale >= 1.0 ? cv::INTER_NEAREST : cv::INTER_AREA);

  const int width = std::max(plan.cols + 2 * kMargin_px, kLeastWidth_px);
  cv::Mat picture(plan.rows + kHeader_px + kFooter_px, width, CV_8UC3, palette::kPanel);
  plan.copyTo(picture({(width - plan.cols) / 2, kHeader_px, plan.cols, plan.rows}));
  drawText(picture, fittedText(title, width - 2 * kMargin_px, kTextSizeLarge),
           {kMargin_px, kHeader_px / 2}, palette::kInk, kTextSizeLarge);
  drawScale(picture, grid, scale / grid.cell_size_m());
  return picture;
}

std::string toText(const OccupancyGrid& grid) {
  if (grid.empty()) return "nothing is known";
  const double cell_m = grid.cell_size_m();
  const auto area = [&](Occupancy kind) {
    const auto count = std::count(grid.cells().begin(), grid.cells().end(), kind);
    return fixedText(static_cast<double>(count) * cell_m * cell_m, 1) + " m2 ";
  };
  return fixedText(cell_m * grid.width(), 1) + " x " + fixedText(cell_m * grid.height(), 1) +
         " m in cells of " + fixedText(cell_m, 2) + " m: " + area(Occupancy::kFree) + "free, " +
         area(Occupancy::kOccupied) + "walls, " + area(Occupancy::kUnknown) + "unknown";
}

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
