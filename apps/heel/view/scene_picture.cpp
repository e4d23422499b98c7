// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/view/scene_picture.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <opencv2/imgproc.hpp>
#include <pcl/common/point_tests.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace heel {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kWidth_px = 960;
constexpr int kHeight_px = 720;
constexpr double kFocal_px = 780.0;  // Of the eye.
constexpr int kHeader_px = 40;
constexpr double kNear_m = 0.1;
constexpr double kUnknownSpacing_m = 0.01;  // of points whose camera is not known

/// The eye: Z forward, X right, Y down, as the cameras.
class Eye {
 public:
  explicit Eye(const ViewPoint& from) {
    const Vector3d forward = (from.target_m - from.eye_m).normalized();
    const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d axes;
    axes << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    T_eye_floor_.linear() = axes;
    T_eye_floor_.translation() = -axes * from.eye_m;
  }

  Vector3d seen(const Vector3d& floor_m) const { return T_eye_floor_ * floor_m; }
  cv::Point2d pixel(const Vector3d& eye_m) const {
    return {kWidth_px / 2.0 + kFocal_px * eye_m.x() / eye_m.z(),
            kHeight_px / 2.0 + kFocal_px * eye_m.y() / eye_m.z()};
  }
  /// Nothing, if the place is behind the eye.
  std::optional<cv::Point2d> operator()(const Vector3d& floor_m) const {
    const Vector3d at = seen(floor_m);
    if (!(at.z() > kNear_m)) return std::nullopt;
    return pixel(at);
  }
  double pixels(double m, double depth_m) const { return kFocal_px * m / depth_m; }

 private:
  Eigen::Isometry3d T_eye_floor_ = Eigen::Isometry3d::Identity();
};

void drawSegment(const Eye& eye, const Vector3d& from, const Vector3d& to, const cv::Scalar& color,
                 int thickness, cv::Mat& picture) {
  const auto a = eye(from), b = eye(to);
  if (a && b) drawLine(picture, *a, *b, color, thickness);
}

/// A grid of metres on the floor, around where one looks.
void drawFloor(const Eye& eye, const ViewPoint& from, cv::Mat& picture) {
  constexpr int kReach_m = 8;
  const int x0 = static_cast<int>(std::round(from.target_m.x()));
  const int y0 = static_cast<int>(std::round(from.target_m.y()));
  for (int i = -kReach_m; i <= kReach_m; ++i) {
    for (int j = -kReach_m; j < kReach_m; ++j) {  // by pieces, for what is behind the eye is cut
      drawSegment(eye, Vector3d(x0 + i, y0 + j, 0), Vector3d(x0 + i, y0 + j + 1, 0),
                  palette::kPanelLit, 1, picture);
      drawSegment(eye, Vector3d(x0 + j, y0 + i, 0), Vector3d(x0 + j + 1, y0 + i, 0),
                  palette::kPanelLit, 1, picture);
    }
  }
}

/// Squares with a depth buffer.
class Splats {
 public:
  explicit Splats(cv::Mat& picture)
      : picture_(picture),
        depth_m_(picture.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::max())) {}

  void add(const Eye& eye, const pcl::PointXYZRGB& point, double spacing_m) {
    constexpr double kLargest_px = 12.0;
    const Vector3d at = eye.seen(point.getVector3fMap().cast<double>());
    if (!(at.z() > kNear_m)) return;
    const cv::Point2d center = eye.pixel(at);
    const double half = std::min(kLargest_px, 0.8 * eye.pixels(spacing_m, at.z()));
    const auto from = [half](double v) { return static_cast<int>(std::lround(v - half)); };
    if (!(std::abs(center.x) < 1e5 && std::abs(center.y) < 1e5)) return;
    const int side = std::max(1, static_cast<int>(std::lround(2.0 * half)));
    const cv::Rect square = cv::Rect(from(center.x), from(center.y), side, side) &
                            cv::Rect(0, 0, picture_.cols, picture_.rows);
    const auto depth_m = static_cast<float>(at.z());
    for (int row = square.y; row < square.br().y; ++row) {
      for (int column = square.x; column < square.br().x; ++column) {
        float& nearest_m = depth_m_.at<float>(row, column);
        if (depth_m >= nearest_m) continue;
        nearest_m = depth_m;
        picture_.at<cv::Vec3b>(row, column) = {point.b, point.g, point.r};
      }
    }
  }

 private:
  cv::Mat& picture_;
  cv::Mat depth_m_;
};

void drawPoints(const Eye& eye, const ViewScene& scene, cv::Mat& picture) {
  Splats splats(picture);
  const Eigen::Vector3f camera = scene.drawn.T_floor_camera.translation().cast<float>();
  const double focal = scene.drawn.camera.fx;
  const auto cloud = tintedCloud(scene);
  for (const auto& point : *cloud) {
    if (!pcl::isFinite(point)) continue;
    const double range_m = double{(point.getVector3fMap() - camera).norm()};
    splats.add(eye, point, focal > 0.0 ? range_m / focal : kUnknownSpacing_m);
  }
  const auto walls = wallPoints(scene.walls);
  for (const auto& point : *walls) {
    splats.add(eye, point, 0.4 * scene.walls.cell_size_m());
  }
}

Outline ring(const Eye& eye, const Vector2d& center_m, double radius_m, double height_m) {
  constexpr int kCorners = 40;
  Outline outline;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    const Vector2d at = center_m + radius_m * Vector2d(std::cos(angle), std::sin(angle));
    if (const auto pixel = eye(Vector3d(at.x(), at.y(), height_m))) outline.push_back(*pixel);
  }
  return outline;
}

void drawTrack(const Eye& eye, const DrawnTrack& track, cv::Mat& picture) {
  const cv::Scalar& color = track.is_target ? palette::kTarget : palette::kTrack;
  const auto onFloor = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  for (std::size_t i = 1; i < track.trail_m.size(); ++i) {
    drawSegment(eye, onFloor(track.trail_m[i - 1], 0.0), onFloor(track.trail_m[i], 0.0), color, 2,
                picture);
  }
  const Vector3d head = onFloor(track.position_m, track.height_m + 0.08);
  for (const double z : {0.0, track.height_m}) {
    drawOutline(picture, ring(eye, track.position_m, 0.28, z), true, color,
                track.is_target ? 3 : 2);
  }
  drawSegment(eye, onFloor(track.position_m, 0.0), onFloor(track.position_m, track.height_m), color,
              track.is_seen ? 2 : 1, picture);
  if (const auto at = eye(head)) {
    const std::string label = track.is_target
                                  ? "target " + fixedText(100.0 * track.confidence, 0) + " %"
                                  : "#" + std::to_string(track.id);
    drawLabel(picture, label, cv::Point(*at) - cv::Point(0, 12), color, palette::kPaper,
              kTextSizeSmall, Align::kCenter);
  }
}

void drawHeader(const DrawnFrame& drawn, cv::Mat& picture) {
  picture.rowRange(0, kHeader_px).setTo(palette::kPaper);
  const cv::Scalar& fill = drawn.tone == Tone::kGood      ? palette::kGood
                           : drawn.tone == Tone::kWarning ? palette::kWarning
                           : drawn.tone == Tone::kBad     ? palette::kBad
                                                          : palette::kGatedOut;
  const int row = kHeader_px / 2;
  int column = 14;
  if (!drawn.state.empty()) {
    column += drawLabel(picture, drawn.state, {column, row}, fill, palette::kPaper) + 12;
  }
  const std::string when =
      "frame " + std::to_string(drawn.frame) + "   " + fixedText(drawn.stamp_s, 2) + " s";
  drawText(picture, when, {picture.cols - 14, row}, palette::kInkSoft, kTextSize, Align::kRight);
  const int room = picture.cols - column - textWidth(when) - 40;
  drawText(picture, fittedText(drawn.reason, std::max(0, room)), {column, row}, palette::kInk);
}

}  // namespace

void drawScene(const ViewScene& scene, const ViewPoint& from, cv::Mat& picture) {
  picture.create(kHeight_px, kWidth_px, CV_8UC3);
  picture.setTo(palette::kPanel);
  const Eye eye(from);
  drawFloor(eye, from, picture);
  drawPoints(eye, scene, picture);
  for (const DrawnBlob& blob : scene.drawn.blobs) {
    drawOutline(picture, ring(eye, blob.position_m, 0.2, 0.0), true,
                blob.is_used ? palette::kBlob : palette::kGatedOut, blob.is_used ? 2 : 1);
  }
  for (const DrawnTrack& track : scene.drawn.tracks) drawTrack(eye, track, picture);
  drawHeader(scene.drawn, picture);
}

}  // namespace heel
