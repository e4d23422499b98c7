// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/picture_parts.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBehind_m = 0.6;  // what is shown behind a camera that stands

/// From the floor to the panel: x (forward) goes up, y (left) goes left.
class PlanView {
 public:
  PlanView(cv::Size panel, const Vector2d& camera_m, double ahead_m, double behind_m)
      : scale_(panel.height / (ahead_m + behind_m)),
        column_(panel.width / 2.0 + camera_m.y() * scale_),
        row_(panel.height - behind_m * scale_ + camera_m.x() * scale_),
        panel_(panel) {}

  cv::Point2d operator()(const Vector2d& floor_m) const {
    return {column_ - floor_m.y() * scale_, row_ - floor_m.x() * scale_};
  }
  Outline operator()(const std::vector<Vector2d>& floor_m) const {
    Outline outline(floor_m.size());
    std::transform(floor_m.begin(), floor_m.end(), outline.begin(), *this);
    return outline;
  }
  double pixels(double m) const { return m * scale_; }

  /// Whole metres of x and y that the panel shows.
  int first_x() const { return static_cast<int>(std::ceil((row_ - panel_.height) / scale_)); }
  int last_x() const { return static_cast<int>(std::floor(row_ / scale_)); }
  int first_y() const { return static_cast<int>(std::ceil((column_ - panel_.width) / scale_)); }
  int last_y() const { return static_cast<int>(std::floor(column_ / scale_)); }

 private:
  double scale_;         // pixels a metre
  double column_, row_;  // of the floor's origin
  cv::Size panel_;
};

void drawGrid(const PlanView& plan, cv::Mat& panel) {
  using namespace palette;
  for (int x = plan.first_x(); x <= plan.last_x(); ++x) {
    const double row = plan(Vector2d(x, 0)).y;
    drawLine(panel, {0, row}, {double(panel.cols), row}, kGrid);
  }
  for (int y = plan.first_y(); y <= plan.last_y(); ++y) {
    const double column = plan(Vector2d(0, y)).x;
    drawLine(panel, {column, 0}, {column, double(panel.rows)}, kGrid);
  }
  for (int x = plan.first_x(); x <= plan.last_x(); ++x) {
    const auto row = static_cast<int>(plan(Vector2d(x, 0)).y);
    if (row < 12) continue;
    drawText(panel, std::to_string(x) + " m", {6, row - 8}, kInkSoft, kTextSizeSmall);
  }
  for (int y = plan.first_y(); y <= plan.last_y(); ++y) {
    const auto column = static_cast<int>(plan(Vector2d(0, y)).x);
    if (column < 40 || column > panel.cols - 30) continue;  // the corners are x's
    drawText(panel, std::to_string(y), {column + 4, panel.rows - 9}, kInkSoft, kTextSizeSmall);
  }
}

/// The camera as a wedge that points where it looks.
void drawCamera(const PlanView& plan, const Eigen::Isometry3d& T_floor_camera, cv::Mat& panel) {
  const Vector2d at_m = T_floor_camera.translation().head<2>();
  Vector2d ahead = T_floor_camera.linear().col(2).head<2>();
  if (ahead.norm() < 1e-6) ahead = Vector2d::UnitX();
  ahead.normalize();
  const Vector2d left(-ahead.y(), ahead.x());
  const std::vector<Vector2d> wedge = {at_m + 0.22 * ahead, at_m - 0.14 * ahead + 0.16 * left,
                                       at_m - 0.05 * ahead, at_m - 0.14 * ahead - 0.16 * left};
  fillOutline(panel, plan(wedge), palette::kInk, 1.0);
}

void drawBlob(const PlanView& plan, const DrawnBlob& blob, cv::Mat& panel) {
  // The area of the mark follows the number of points: 0.1 m at none, 0.35 m at 4000 and more.
  const double share = std::min(1.0, std::sqrt(std::max(0, blob.points) / 4000.0));
  const double radius = plan.pixels(0.1 + 0.25 * share);
  const cv::Point2d at = plan(blob.position_m);
  const cv::Scalar& color = blob.is_used ? palette::kBlob : palette::kGatedOut;
  if (blob.is_used) fillCircle(panel, at, radius, color, 0.35);
  drawCircle(panel, at, radius, color);
  if (!blob.is_used) {
    const cv::Point2d slash(0.7 * radius, -0.7 * radius);
    drawLine(panel, at - slash, at + slash, color);
  }
}

void drawTrail(const PlanView& plan, const DrawnTrack& track, const cv::Scalar& color,
               cv::Mat& panel) {
  const Outline trail = plan(track.trail_m);
  const auto n = static_cast<double>(trail.size());
  for (std::size_t i = 1; i < trail.size(); ++i) {
    const double age = 1.0 - static_cast<double>(i) / n;  // the old part fades into the panel
    drawLine(panel, trail[i - 1], trail[i], mixed(color, palette::kPanelLit, 0.85 * age),
             track.is_target ? 2 : 1);
  }
}

void drawTrack(const PlanView& plan, const DrawnTrack& track, cv::Mat& panel) {
  const cv::Scalar& color = track.is_target ? palette::kTarget : palette::kTrack;
  drawTrail(plan, track, color, panel);
  const cv::Point2d at = plan(track.position_m);
  const double radius = track.is_target ? 8.0 : 5.0;
  if (track.velocity_mps.norm() > 0.1) {  // where it will be in a second
    drawLine(panel, at, plan(Vector2d(track.position_m + track.velocity_mps)), color,
             track.is_target ? 2 : 1);
  }
  if (track.is_target) drawCircle(panel, at, radius + 5.0, color, 1);
  fillCircle(panel, at, radius, track.is_seen ? color : palette::kPanel);
  drawCircle(panel, at, radius, color, track.is_target ? 2 : 1);
  const cv::Point beside(static_cast<int>(at.x + (track.is_target ? 26.0 : 18.0)),
                         static_cast<int>(at.y));
  drawText(panel, std::to_string(track.id), beside, color,
           track.is_target ? kTextSize : kTextSizeSmall);
}

}  // namespace

std::vector<Vector2d> visibleFloor(const PinholeCamera& camera,
                                   const Eigen::Isometry3d& T_floor_camera, double range_m) {
  std::vector<Vector2d> floor_m;
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) return floor_m;
  const Vector3d eye_m = T_floor_camera.translation();
  const auto look = [&](double u, double v) {
    const Vector3d ray = T_floor_camera.linear() * rayOf(camera, u, v);
    const double across = ray.head<2>().norm();
    if (across < 1e-9) {
      floor_m.emplace_back(eye_m.head<2>());
      return;
    }
    // Where the ray meets the floor, or the range where it does so further away or never.
    double reach_m = range_m;
    if (ray.z() < 0.0) reach_m = std::min(range_m, eye_m.z() / -ray.z() * across);
    floor_m.emplace_back(eye_m.head<2>() + ray.head<2>() / across * reach_m);
  };
  constexpr int kSteps = 16;  // on each side of the image
  const double w = camera.width, h = camera.height;
  for (int i = 0; i < kSteps; ++i) look(w * i / kSteps, 0.0);
  for (int i = 0; i < kSteps; ++i) look(w, h * i / kSteps);
  for (int i = 0; i < kSteps; ++i) look(w - w * i / kSteps, h);
  for (int i = 0; i < kSteps; ++i) look(0.0, h - h * i / kSteps);
  return floor_m;
}

void drawPlan(const DrawnFrame& scene, double ahead_m, cv::Mat& panel) {
  panel.setTo(palette::kPanel);
  const PlanView plan(panel.size(), scene.T_floor_camera.translation().head<2>(), ahead_m,
                      scene.camera_turns ? ahead_m : kBehind_m);
  fillOutline(panel, plan(visibleFloor(scene.camera, scene.T_floor_camera, 2.0 * ahead_m)),
              palette::kPanelLit, 1.0);
  drawGrid(plan, panel);
  if (scene.bounds_m) {
    const Vector2d a = scene.bounds_m->min(), b = scene.bounds_m->max();
    drawOutline(panel, plan({a, Vector2d(a.x(), b.y()), b, Vector2d(b.x(), a.y())}), true,
                palette::kInkSoft, 1);
  }
  drawCamera(plan, scene.T_floor_camera, panel);
  for (const auto& blob : scene.blobs) drawBlob(plan, blob, panel);
  for (const auto& track : scene.tracks) {
    if (!track.is_target) drawTrack(plan, track, panel);
  }
  for (const auto& track : scene.tracks) {  // the target lies on top
    if (track.is_target) drawTrack(plan, track, panel);
  }
}

}  // namespace heel
