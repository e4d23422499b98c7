// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/planview/cloud_plan.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

namespace {

using Eigen::Vector2d;

constexpr int kSize_px = 760;
constexpr int kHeader_px = 64;
constexpr double kMargin_m = 0.5;
constexpr double kLeastWidth_m = 4.0;
constexpr float kBright_m = 2.0F;  // cells of this height and more are brightest

/// From the floor to the picture: x goes up, y to the left.
class FloorScale {
 public:
  explicit FloorScale(const CloudPlan& plan) {
    Eigen::AlignedBox2d shown(plan.T_base_cloud.translation().head<2>());
    for (const int cell : plan.view->occupied()) shown.extend(plan.view->center(cell));
    const Vector2d margin(kMargin_m, kMargin_m);
    shown.extend(Vector2d(shown.max() + margin));
    shown.extend(Vector2d(shown.min() - margin));
    const double side_m = std::max({shown.sizes().x(), shown.sizes().y(), kLeastWidth_m});
    scale_ = kSize_px / side_m;
    top_left_m_ = shown.center() + Vector2d(side_m / 2.0, side_m / 2.0);
  }

  cv::Point2d operator()(const Vector2d& floor_m) const {
    const Vector2d down_right = (top_left_m_ - floor_m) * scale_;
    return {down_right.y(), down_right.x()};
  }
  double pixels(double m) const { return m * scale_; }
  const Vector2d& topLeft_m() const { return top_left_m_; }
  double side_m() const { return kSize_px / scale_; }

 private:
  double scale_;
  Vector2d top_left_m_;
};

void drawGrid(const FloorScale& floor, cv::Mat& panel) {
  const int step = floor.side_m() > 12.0 ? 2 : 1;
  const auto each = [&](double last_m, const auto& draw) {
    for (int m = static_cast<int>(std::ceil(last_m - floor.side_m())); m < last_m; ++m) {
      if (m % step == 0) draw(m);
    }
  };
  each(floor.topLeft_m().x(), [&](int x) {
    const double row = floor({double(x), 0.0}).y;
    drawLine(panel, {0, row}, {double(kSize_px), row}, palette::kGrid);
    drawText(panel, std::to_string(x) + " m", {6, static_cast<int>(row) - 8}, palette::kInkSoft,
             kTextSizeSmall);
  });
  each(floor.topLeft_m().y(), [&](int y) {
    const double column = floor({0.0, double(y)}).x;
    drawLine(panel, {column, 0}, {column, double(kSize_px)}, palette::kGrid);
    drawText(panel, std::to_string(y), {static_cast<int>(column) + 4, kSize_px - 9},
             palette::kInkSoft, kTextSizeSmall);
  });
}

void drawCells(const CloudPlan& plan, const FloorScale& floor, cv::Mat& panel) {
  const auto& cells = plan.view->occupied();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const float height_m = (*plan.view)[cells[i]].max_height_m;
    const double share = std::clamp(0.2 + 0.8 * double(height_m / kBright_m), 0.2, 1.0);
    const bool in_blob = plan.blob_of_cell[i] >= 0;
    const cv::Scalar& bright = in_blob ? palette::kBlob : palette::kGatedOut;
    const Vector2d half = Vector2d::Constant(plan.view->cellSize() / 2.0);
    const Vector2d center = plan.view->center(cells[i]);
    cv::rectangle(panel, floor(center + half), floor(center - half),
                  mixed(palette::kPanel, bright, share), cv::FILLED);
  }
}

/// The cloud's origin, as a wedge that points where it looks, and the edges of what it sees.
void drawOrigin(const CloudPlan& plan, const FloorScale& floor, cv::Mat& panel) {
  const Vector2d at = plan.T_base_cloud.translation().head<2>();
  if (plan.heading_rad > 0.0) {
    for (const double side : {-1.0, 1.0}) {
      const Vector2d edge = Eigen::Rotation2Dd(side * plan.heading_rad) * Vector2d::UnitX();
      drawLine(panel, floor(at), floor(at + 30.0 * edge), palette::kGrid, 2);
    }
  }
  const double m = 14.0 / floor.pixels(1.0);
  fillOutline(panel,
              {floor(at + m * Vector2d(0.9, 0.0)), floor(at + m * Vector2d(-0.6, 0.7)),
               floor(at + m * Vector2d(-0.2, 0.0)), floor(at + m * Vector2d(-0.6, -0.7))},
              palette::kInk, 1.0);
}

void drawBlobs(const CloudPlan& plan, const FloorScale& floor, cv::Mat& panel) {
  constexpr std::size_t kMostLabels = 40;
  for (std::size_t i = plan.blobs.size(); i-- > 0;) {  // the highest score on top
    const WorldBlob& blob = plan.blobs[i];
    const cv::Point2d at = floor(blob.position_m);
    const bool is_person = plan.is_person[i];
    const double radius =
        std::max(floor.pixels(blob.extent_m / 2.0), is_person ? floor.pixels(0.3) : 6.0);
    const cv::Scalar& color = is_person ? palette::kGood : palette::kInkSoft;
    drawCircle(panel, at, radius, color, is_person ? 3 : 1);
    if (i >= kMostLabels) continue;
    const std::string label =
        std::to_string(i + 1) + (is_person ? ": " + fixedText(blob.max_height_m, 2) + " m" : "");
    if (is_person) {
      drawLabel(panel, label, at + cv::Point2d(0.0, radius + 14.0), palette::kGood, palette::kPaper,
                kTextSizeSmall, Align::kCenter);
    } else {
      drawText(panel, label, at, palette::kInk, kTextSizeSmall, Align::kCenter);
    }
  }
}

std::string describe(const CloudPlan& plan) {
  const std::string eye = fixedText(plan.mounting.height_m, 2) + " m over the floor, pitch " +
                          fixedText(plan.mounting.pitch_rad * kDegrees, 1) + " deg (" +
                          toText(plan.floor) + ")";
  return std::to_string(plan.view->points()) + " points, " + std::to_string(plan.blobs.size()) +
         " blobs, " + std::to_string(plan.people()) + " of a person's shape; origin " + eye;
}

}  // namespace

cv::Mat drawPlanView(const CloudPlan& plan, const std::string& title) {
  cv::Mat picture(kSize_px + kHeader_px, kSize_px, CV_8UC3, palette::kPaper);
  cv::Mat panel = picture(cv::Rect(0, kHeader_px, kSize_px, kSize_px));
  panel.setTo(palette::kPanel);
  const FloorScale floor(plan);
  drawCells(plan, floor, panel);
  drawGrid(floor, panel);
  drawOrigin(plan, floor, panel);
  drawBlobs(plan, floor, panel);
  drawText(picture, fittedText(title, kSize_px - 32, kTextSizeLarge), {16, 22}, palette::kInk,
           kTextSizeLarge);
  drawText(picture, fittedText(describe(plan), kSize_px - 32, kTextSizeSmall), {16, 46},
           palette::kInkSoft, kTextSizeSmall);
  return picture;
}

}  // namespace heel
