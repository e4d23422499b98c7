// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/map_picture.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

}  // namespace heel
