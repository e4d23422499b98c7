// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/follow_video.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/map_picture.hpp>
#include <heel/apps/pictures/picture_parts.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr int kPanelHeight_px = 540;  // Of the image and of the map beside it.
constexpr int kImageWidth_px = 720;   // 4 : 3.
constexpr int kLeastMapWidth_px = 380;
constexpr int kMostMapWidth_px = 760;
constexpr double kViewRange_m = 6.0;  // How far the camera's field of view is drawn.
constexpr int kMargin = 12;
constexpr int kHeader = 44;
constexpr int kFooter = 30;
constexpr double kPersonRadius_m = 0.22;
constexpr double kAround_m = 6.0;  // Of the robot, so much is shown where there are no walls.
constexpr int kCorners = 48;       // Of the drawn body; as many at its front as at its back.

const cv::Scalar kWall(196, 186, 176);
const cv::Scalar kRobot(240, 170, 96);
const cv::Scalar kPath(214, 200, 120);
const cv::Scalar kObstacle(110, 90, 200);

const std::vector<LegendEntry> kLegend = {
    {"robot", kRobot},
    {"its pose as it believes", kRobot, LegendEntry::Mark::kRing},
    {"person", palette::kTarget},
    {"where the robot takes them to be", palette::kTarget, LegendEntry::Mark::kRing},
    {"others", palette::kInkSoft},
    {"planned path", kPath, LegendEntry::Mark::kLine},
    {"obstacles not in the map", kObstacle, LegendEntry::Mark::kSquare}};

int even(int pixels) { return pixels + pixels % 2; }

/// A trail that fades into the panel where it is old.
void drawTrail(const Outline& trail, const cv::Scalar& color, cv::Mat& panel) {
  const auto n = static_cast<double>(trail.size());
  for (std::size_t i = 1; i < trail.size(); ++i) {
    const double age = 1.0 - static_cast<double>(i) / n;
    drawLine(panel, trail[i - 1], trail[i], mixed(color, palette::kPanel, 0.8 * age), 2);
  }
}

}  // namespace

FollowVideo::FollowVideo(const OccupancyGrid& map, const DriveLimits& robot)
    : grid_(map), robot_(robot), bounds_m_(occupiedBounds(map)) {
  if (map.empty()) throw std::invalid_argument("FollowVideo: the map is empty");
  if (bounds_m_.isEmpty()) {
    goes_along_ = true;
    bounds_m_ = {Vector2d::Constant(-kAround_m), Vector2d::Constant(kAround_m)};
  }
  bounds_m_.min() -= Vector2d::Constant(0.2);
  bounds_m_.max() += Vector2d::Constant(0.2);
  drawMap();
}

cv::Rect FollowVideo::imageArea() const {
  return {kMargin, kHeader, kImageWidth_px, kPanelHeight_px};
}

cv::Rect FollowVideo::mapArea() const {
  return {imageArea().br().x + kMargin, kHeader, map_.cols, kPanelHeight_px};
}

cv::Size FollowVideo::size() const {
  return {even(mapArea().br().x + kMargin), even(kHeader + kPanelHeight_px + kFooter)};
}

cv::Point2d FollowVideo::onMap(const Vector2d& place_m) const {
  const Vector2d middle = bounds_m_.center();
  return {map_.cols / 2.0 + scale_ * (place_m.x() - middle.x()),
          map_.rows / 2.0 - scale_ * (place_m.y() - middle.y())};
}

std::vector<cv::Point2d> FollowVideo::onMap(const std::vector<Vector2d>& places_m) const {
  Outline outline;
  for (const Vector2d& place_m : places_m) {
    if (place_m.allFinite()) outline.push_back(onMap(place_m));
  }
  return outline;
}

cv::Point2d FollowVideo::pixelOf(const Vector2d& place_m) const {
  return onMap(place_m) + cv::Point2d(mapArea().tl());
}

void FollowVideo::drawMap() {
  const Vector2d size_m = bounds_m_.sizes();
  const auto fitting = static_cast<int>(std::lround(kPanelHeight_px * size_m.x() / size_m.y()));
  const int width = std::clamp(fitting, kLeastMapWidth_px, kMostMapWidth_px);
  map_.create(kPanelHeight_px, width, CV_8UC3);
  map_.setTo(palette::kPanel);
  scale_ = std::min(width / size_m.x(), kPanelHeight_px / size_m.y());
  if (goes_along_) return;
  for (int row = 0; row < map_.rows; ++row) {
    for (int column = 0; column < map_.cols; ++column) {
      const Vector2d place =
          bounds_m_.center() +
          Vector2d(column + 0.5 - map_.cols / 2.0, map_.rows / 2.0 - row - 0.5) / scale_;
      const Occupancy what = grid_.at(place);
      if (what == Occupancy::kFree) continue;
      const cv::Scalar& c = what == Occupancy::kOccupied ? kWall : palette::kPaper;
      map_.at<cv::Vec3b>(row, column) = {cv::saturate_cast<uchar>(c[0]),
                                         cv::saturate_cast<uchar>(c[1]),
                                         cv::saturate_cast<uchar>(c[2])};
    }
  }
}

/// From the camera on along the rays of its columns, each up to a wall.
std::vector<Vector2d> FollowVideo::seenArea(const DrawnFrame& view) const {
  if (!(view.camera.fx > 0.0) || !view.T_floor_camera.matrix().allFinite()) return {};
  constexpr int kRays = 96;
  const Vector2d eye = view.T_floor_camera.translation().head<2>();
  std::vector<Vector2d> area = {eye};
  for (int i = 0; i <= kRays; ++i) {
    const double column = view.camera.width * double(i) / kRays;
    const Eigen::Vector3d ray =
        view.T_floor_camera.linear() * rayOf(view.camera, column, view.camera.cy);
    const Vector2d along = ray.head<2>().normalized();
    double reach_m = 0.0;
    while (reach_m < kViewRange_m &&
           grid_.at(Vector2d(eye + reach_m * along)) != Occupancy::kOccupied) {
      reach_m += grid_.cell_size_m();
    }
    area.emplace_back(eye + std::min(reach_m, kViewRange_m) * along);
  }
  return area;
}

void FollowVideo::drawObstacles(const FollowVideoFrame& frame, cv::Mat& panel) const {
  const double half = std::max(1.0, 0.5 * scale_ * frame.obstacle_cell_m);
  const cv::Rect all(0, 0, panel.cols, panel.rows);
  for (const cv::Point2d& at : onMap(frame.obstacles)) {
    const cv::Rect cell(cvFloor(at.x - half), cvFloor(at.y - half), cvCeil(2 * half),
                        cvCeil(2 * half));
    if ((cell & all).area() > 0) panel(cell & all).setTo(kObstacle);
  }
}

/// The body's outline, so much wider.
std::vector<cv::Point2d> FollowVideo::bodyAt(const FloorPose& pose, double wider_m) const {
  std::vector<Vector2d> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * M_PI / kCorners * (i + 0.5);
    const double middle_m = std::cos(angle) > 0.0 ? robot_.front_m : robot_.back_m;
    rim.push_back(pose *
                  (Vector2d(middle_m, 0.0) +
                   (robot_.radius_m + wider_m) * Vector2d(std::cos(angle), std::sin(angle))));
  }
  return onMap(rim);
}

void FollowVideo::drawRobot(const FollowVideoFrame& frame, cv::Mat& panel) const {
  if (frame.robot_true.position.allFinite()) {
    const FloorPose& pose = frame.robot_true;
    fillOutline(panel, bodyAt(pose), kRobot, 0.75);
    drawLine(panel, onMap(pose.position),
             onMap(pose * Vector2d(robot_.front_m + 1.4 * robot_.radius_m, 0.0)), palette::kInk, 2);
  }
  if (frame.robot_estimated.position.allFinite()) {
    drawOutline(panel, bodyAt(frame.robot_estimated), true, kRobot);
    if (frame.position_sigma_m > 0.0) {
      const double wider_m = 2.0 * std::min(frame.position_sigma_m, 5.0);
      drawOutline(panel, bodyAt(frame.robot_estimated, wider_m), true, kRobot);
    }
  }
}

void FollowVideo::drawPeople(const FollowVideoFrame& frame, cv::Mat& panel) const {
  const double radius = scale_ * kPersonRadius_m;
  for (const cv::Point2d& at : onMap(frame.others_true)) {
    fillCircle(panel, at, radius, palette::kInkSoft, 0.7);
  }
  if (frame.person_true && frame.person_true->allFinite()) {
    fillCircle(panel, onMap(*frame.person_true), radius, palette::kTarget, 0.85);
  }
  if (frame.target_estimate && frame.target_estimate->allFinite()) {
    drawCircle(panel, onMap(*frame.target_estimate), radius + 5.0, palette::kTarget, 2);
  }
}

void FollowVideo::draw(const FollowVideoFrame& frame, cv::Mat& picture) {
  const Vector2d& robot = frame.robot_estimated.position;
  if (goes_along_ && robot.allFinite()) bounds_m_.translate(robot - bounds_m_.center());
  picture.create(size(), CV_8UC3);
  picture.setTo(palette::kPaper);
  cv::Mat image = picture(imageArea());
  drawImage(frame.view, image);

  cv::Mat panel = picture(mapArea());
  map_.copyTo(panel);
  fillOutline(panel, onMap(seenArea(frame.view)), palette::kInk, 0.12);
  drawObstacles(frame, panel);
  drawTrail(onMap(frame.person_trail), palette::kTarget, panel);
  drawTrail(onMap(frame.robot_trail), kRobot, panel);
  drawOutline(panel, onMap(frame.path), false, kPath, 2);
  drawPeople(frame, panel);
  drawRobot(frame, panel);

  const int width = size().width - 2 * kMargin;
  cv::Mat header = picture(cv::Rect(kMargin, 0, width, kHeader));
  drawHeader(frame.view.state, frame.view.tone, frame.view.reason,
             fixedText(frame.view.stamp_s, 1) + " s", header);
  cv::Mat footer = picture(cv::Rect(kMargin, imageArea().br().y, width, kFooter));
  drawLegend(kLegend, footer);
}

}  // namespace heel
