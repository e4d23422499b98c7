// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/picture_parts.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace heel {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPersonRadius_m = 0.3;
constexpr double kBlobRadius_m = 0.15;

/// Outlines what the mask lets pass. Specks, of which a real picture has many, are left out.
void outline(const cv::Mat& mask, cv::Mat& image) {
  constexpr double kLeastArea_px = 200.0;
  constexpr int kSmoothed_px = 9;
  cv::Mat fitted;
  cv::resize(mask, fitted, image.size(), 0, 0, cv::INTER_NEAREST);
  cv::medianBlur(fitted, fitted, kSmoothed_px);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(fitted, outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (cv::contourArea(outlines[i]) < kLeastArea_px) continue;
    cv::drawContours(image, outlines, static_cast<int>(i), palette::kBlob, 1, cv::LINE_AA);
  }
}

/// Marks on the image what stands on the floor.
class Marker {
 public:
  /// @param scale  Pixels of `image` for one of the camera.
  Marker(const DrawnFrame& scene, double scale, cv::Mat image)
      : scene_(scene), scale_(scale), image_(std::move(image)) {}

  void mark(const DrawnBlob& blob) {
    drawOutline(image_, ring(blob.position_m, kBlobRadius_m), true,
                blob.is_used ? palette::kBlob : palette::kGatedOut);
  }

  void mark(const DrawnTrack& track) {
    const cv::Scalar& color = track.is_target ? palette::kTarget : palette::kTrack;
    const int thickness = track.is_target ? 2 : 1;
    const Outline feet = ring(track.position_m, kPersonRadius_m);
    if (track.is_target) fillOutline(image_, feet, color, 0.35);
    drawOutline(image_, feet, true, color, thickness);

    // Of an upright rectangle that faces the camera, the ends of the sides and the upper corners:
    // a frame that leaves the person to be seen.
    const Outline sides = standingRectangle(track);
    if (sides.empty()) return;
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      const cv::Point2d quarter = 0.25 * (sides[i + 1] - sides[i]);
      drawLine(image_, sides[i], sides[i] + quarter, color, thickness);
      drawLine(image_, sides[i + 1] - quarter, sides[i + 1], color, thickness);
    }
    if (isInImage(sides)) label(track, 0.5 * (sides[1] + sides[2]), color);
  }

 private:
  /// The shape on the image; empty if a part of it is behind the camera.
  Outline project(const std::vector<Vector3d>& shape_m) const {
    Outline outline;
    for (const auto& point_m : shape_m) {
      const auto pixel = projectToImage(point_m, scene_.camera, scene_.T_floor_camera);
      if (!pixel) return {};
      outline.push_back(*pixel * scale_);
    }
    return outline;
  }

  /// A circle on the floor.
  Outline ring(const Vector2d& center_m, double radius_m) const {
    constexpr int kCorners = 40;
    std::vector<Vector3d> circle_m;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * M_PI * i / kCorners;
      circle_m.emplace_back(center_m.x() + radius_m * std::cos(angle),
                            center_m.y() + radius_m * std::sin(angle), 0.0);
    }
    return project(circle_m);
  }

  /// Left foot, left and right of the head, right foot, as the camera sees them.
  Outline standingRectangle(const DrawnTrack& track) const {
    const Vector2d eye_m = scene_.T_floor_camera.translation().head<2>();
    const Vector2d away = (track.position_m - eye_m).normalized();
    const Vector2d side_m = kPersonRadius_m * Vector2d(-away.y(), away.x());
    const Vector2d left = track.position_m + side_m, right = track.position_m - side_m;
    return project({{left.x(), left.y(), 0.0},
                    {left.x(), left.y(), track.height_m},
                    {right.x(), right.y(), track.height_m},
                    {right.x(), right.y(), 0.0}});
  }

  bool isInImage(const Outline& outline) const {
    const auto [left, right] = std::minmax_element(
        outline.begin(), outline.end(), [](cv::Point2d a, cv::Point2d b) { return a.x < b.x; });
    const auto [top, bottom] = std::minmax_element(
        outline.begin(), outline.end(), [](cv::Point2d a, cv::Point2d b) { return a.y < b.y; });
    return right->x > 0.0 && left->x < image_.cols && bottom->y > 0.0 && top->y < image_.rows;
  }

  /// The track's name over its head, kept within the image.
  void label(const DrawnTrack& track, cv::Point2d head, const cv::Scalar& color) {
    std::string text = std::to_string(track.id);
    if (track.is_target) {
      const auto percent = std::lround(100.0 * track.confidence);
      text = "target " + text + "  " + std::to_string(percent) + " %";
    }
    constexpr int kHalfHeight = 16;
    const int half_width = textWidth(text) / 2 + 14;
    const auto within = [](double value, int half, int size) {
      return static_cast<int>(std::clamp<double>(value, half, std::max(half, size - half)));
    };
    const cv::Point at(within(head.x, half_width, image_.cols),
                       within(head.y - kHalfHeight, kHalfHeight, image_.rows));
    if (track.is_target) {
      drawLabel(image_, text, at, color, palette::kPaper, kTextSize, Align::kCenter);
    } else {
      drawLabel(image_, text, at, palette::kPaper, color, kTextSizeSmall, Align::kCenter);
    }
  }

  const DrawnFrame& scene_;
  double scale_;
  cv::Mat image_;
};

}  // namespace

void drawImage(const DrawnFrame& scene, cv::Mat& panel) {
  panel.setTo(palette::kPanel);
  if (scene.image_bgr.empty()) {
    drawText(panel, "no image", {panel.cols / 2, panel.rows / 2}, palette::kInkSoft, kTextSizeLarge,
             Align::kCenter);
    return;
  }
  const cv::Size size = scene.image_bgr.size();
  const double scale = std::min(double(panel.cols) / size.width, double(panel.rows) / size.height);
  const cv::Size fitted(static_cast<int>(size.width * scale + 0.5),
                        static_cast<int>(size.height * scale + 0.5));
  const cv::Point corner((panel.cols - fitted.width) / 2, (panel.rows - fitted.height) / 2);
  cv::Mat image = panel(cv::Rect(corner, fitted));
  cv::resize(scene.image_bgr, image, fitted);
  if (!scene.mask.empty()) outline(scene.mask, image);
  Marker marker(scene, scale, image);
  for (const auto& blob : scene.blobs) marker.mark(blob);
  for (const auto& track : scene.tracks) {
    if (!track.is_target) marker.mark(track);
  }
  for (const auto& track : scene.tracks) {  // the target lies on top
    if (track.is_target) marker.mark(track);
  }
}

std::optional<cv::Point2d> projectToImage(const Vector3d& point_m, const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera) {
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) return std::nullopt;
  const Vector3d p = T_floor_camera.inverse() * point_m;
  constexpr double kNear_m = 0.1;
  if (!(p.z() > kNear_m)) return std::nullopt;
  const Eigen::Vector2d pixel = project(camera, p);
  return cv::Point2d(pixel.x(), pixel.y());
}

}  // namespace heel
