// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/report/annotate.hpp"

#include "apps/report/csv_file.hpp"
#include "apps/report/drawing.hpp"
#include "apps/report/plan_picture.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMargin = 12;
constexpr int kHeader = 44;
constexpr int kFooter = 30;
constexpr double kPersonHalfWidth_m = 0.3;

int even(int pixels) { return pixels + pixels % 2; }

cv::Size imagePanelSize(const AnnotateParams& params) {
  return {static_cast<int>(std::lround(params.panel_height_px * params.image_aspect)),
          params.panel_height_px};
}

/// The image panel: the frame's image, scaled to fit, and what is marked on it.
class ImagePanel {
 public:
  ImagePanel(const Scene& scene, cv::Mat& panel) : scene_(scene), panel_(panel) {
    panel_.setTo(palette::kPanel);
    if (scene.image_bgr.empty()) {
      drawText(panel_, "no image", {panel_.cols / 2, panel_.rows / 2}, palette::kInkSoft,
               kTextSizeLarge, Align::kCenter);
      return;
    }
    const cv::Size size = scene.image_bgr.size();
    scale_ = std::min(double(panel_.cols) / size.width, double(panel_.rows) / size.height);
    const cv::Size fitted(static_cast<int>(size.width * scale_ + 0.5),
                          static_cast<int>(size.height * scale_ + 0.5));
    corner_ = {(panel_.cols - fitted.width) / 2, (panel_.rows - fitted.height) / 2};
    area_ = panel_(cv::Rect(corner_, fitted));
    cv::resize(scene.image_bgr, area_, fitted, 0, 0, cv::INTER_LINEAR);
    tint(fitted);
    for (const auto& blob : scene.blobs) mark(blob);
    for (const auto& track : scene.tracks) {
      if (!track.is_target) mark(track);
    }
    for (const auto& track : scene.tracks) {  // the target lies on top
      if (track.is_target) mark(track);
    }
  }

 private:
  /// Dims the image where the mask is 0 and mixes the blobs' colour in where it is not.
  void tint(cv::Size fitted) {
    if (scene_.mask.empty()) return;
    cv::Mat mask;
    cv::resize(scene_.mask, mask, fitted, 0, 0, cv::INTER_NEAREST);
    const cv::Scalar& color = palette::kBlob;
    constexpr double kDim = 0.72, kTint = 0.5;
    for (int v = 0; v < fitted.height; ++v) {
      const auto* passed = mask.ptr<std::uint8_t>(v);
      auto* pixels = area_.ptr<cv::Vec3b>(v);
      for (int u = 0; u < fitted.width; ++u) {
        for (int c = 0; c < 3; ++c) {
          const double value = pixels[u][c];
          const double mixed_value =
              passed[u] != 0 ? (1.0 - kTint) * value + kTint * color[c] : kDim * value;
          pixels[u][c] = static_cast<std::uint8_t>(mixed_value + 0.5);
        }
      }
    }
  }

  std::optional<cv::Point2d> project(const Vector2d& floor_m, double height_m) const {
    auto p =
        projectToImage({floor_m.x(), floor_m.y(), height_m}, scene_.camera, scene_.T_floor_camera);
    if (p) p = *p * scale_;
    return p;
  }

  /// The shape on the image; empty if a part of it is behind the camera.
  Outline project(const std::vector<Vector3d>& shape_m) const {
    Outline outline;
    for (const auto& point : shape_m) {
      const auto p = project(Vector2d(point.head<2>()), point.z());
      if (!p) return {};
      outline.push_back(*p);
    }
    return outline;
  }

  /// A circle on the floor.
  Outline ring(const Vector2d& center_m, double radius_m) const {
    std::vector<Vector3d> circle;
    constexpr int kCorners = 40;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * M_PI * i / kCorners;
      circle.emplace_back(center_m.x() + radius_m * std::cos(angle),
                          center_m.y() + radius_m * std::sin(angle), 0.0);
    }
    return project(circle);
  }

  void mark(const SceneBlob& blob) {
    const auto foot = project(blob.position_m, 0.0);
    if (!foot) return;
    const cv::Scalar& color = blob.is_used ? palette::kBlob : palette::kGatedOut;
    drawOutline(area_, ring(blob.position_m, 0.15), true, color, 1);
  }

  void mark(const SceneTrack& track) {
    const cv::Scalar& color = track.is_target ? palette::kTarget : palette::kTrack;
    const Outline feet = ring(track.position_m, kPersonHalfWidth_m);
    if (track.is_target) fillOutline(area_, feet, color, 0.35);
    drawOutline(area_, feet, true, color, track.is_target ? 2 : 1);

    // An upright rectangle that faces the camera, of which the ends of the sides and the upper
    // corners are drawn: a frame that leaves the person to be seen.
    const Vector2d eye_m = scene_.T_floor_camera.translation().head<2>();
    const Vector2d away = (track.position_m - eye_m).normalized();
    const Vector2d side = kPersonHalfWidth_m * Vector2d(-away.y(), away.x());
    const Vector2d left = track.position_m + side, right = track.position_m - side;
    const double top_m = track.height_m;
    const Outline box =
        project({Vector3d(left.x(), left.y(), 0.0), Vector3d(left.x(), left.y(), top_m),
                 Vector3d(right.x(), right.y(), top_m), Vector3d(right.x(), right.y(), 0.0)});
    if (box.empty()) return;
    const int thickness = track.is_target ? 2 : 1;
    for (std::size_t i = 0; i + 1 < box.size(); ++i) {
      const cv::Point2d quarter = 0.25 * (box[i + 1] - box[i]);
      drawLine(area_, box[i], box[i] + quarter, color, thickness);
      drawLine(area_, box[i + 1] - quarter, box[i + 1], color, thickness);
    }
    label(track, 0.5 * (box[1] + box[2]), color);
  }

  /// The track's name over its head, kept within the image.
  void label(const SceneTrack& track, cv::Point2d head, const cv::Scalar& color) {
    const std::string text =
        track.is_target
            ? "target " + std::to_string(track.id) + "  " +
                  std::to_string(static_cast<int>(std::lround(100.0 * track.confidence))) + " %"
            : std::to_string(track.id);
    const int half = textWidth(text) / 2 + 14;
    const cv::Point at(
        std::clamp(static_cast<int>(head.x), half, std::max(half, area_.cols - half)),
        std::clamp(static_cast<int>(head.y) - 16, 16, area_.rows - 16));
    const double outside = std::max({-head.x, head.x - area_.cols, -head.y - 200.0, 0.0});
    if (outside > 40.0) return;  // a person who is not in the image
    if (track.is_target) {
      drawLabel(area_, text, at, color, palette::kPaper, kTextSize, Align::kCenter);
    } else {
      drawLabel(area_, text, at, palette::kPaper, color, kTextSizeSmall, Align::kCenter);
    }
  }

  const Scene& scene_;
  cv::Mat& panel_;
  cv::Mat area_;  // of the image in the panel
  cv::Point corner_;
  double scale_ = 1.0;
};

const cv::Scalar& colorOf(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return palette::kGood;
    case Tone::kWarning:
      return palette::kWarning;
    case Tone::kBad:
      return palette::kBad;
    case Tone::kNeutral:
      break;
  }
  return palette::kInkSoft;
}

void drawHeader(const Scene& scene, cv::Mat& header) {
  const int row = header.rows / 2;
  const std::string time =
      "frame " + std::to_string(scene.frame) + "    " + fixedText(scene.stamp_s, 2) + " s";
  drawText(header, time, {header.cols, row}, palette::kInkSoft, kTextSize, Align::kRight);
  int column = 0;
  if (!scene.state.empty()) {
    column = 14 + drawLabel(header, scene.state, {0, row}, colorOf(scene.tone), palette::kPaper,
                            kTextSizeLarge);
  }
  const int room = header.cols - textWidth(time) - 24 - column;
  drawText(header, fittedText(scene.reason, room), {column, row}, palette::kInk);
}

/// What the marks mean.
void drawFooter(cv::Mat& footer) {
  using namespace palette;
  const int row = footer.rows / 2;
  int column = 6;
  const auto entry = [&](const std::string& text, const cv::Scalar& color, bool filled) {
    const cv::Point2d at(column, row);
    if (filled) {
      fillCircle(footer, at, 5.0, color);
    } else {
      drawCircle(footer, at, 5.0, color);
    }
    drawText(footer, text, {column + 13, row}, kInkSoft, kTextSizeSmall);
    column += 13 + textWidth(text, kTextSizeSmall) + 26;
  };
  entry("target", kTarget, true);
  entry("other tracks", kTrack, true);
  entry("predicted, not seen", kTrack, false);
  entry("candidate", kBlob, false);
  entry("candidate thrown out", kGatedOut, false);
  fillOutline(footer,
              {cv::Point2d(column - 5, row - 5), cv::Point2d(column + 5, row - 5),
               cv::Point2d(column + 5, row + 5), cv::Point2d(column - 5, row + 5)},
              kBlob, 0.7);
  drawText(footer, "the target's colours", {column + 13, row}, kInkSoft, kTextSizeSmall);
  column += 13 + textWidth("the target's colours", kTextSizeSmall) + 26;
}

}  // namespace

std::optional<cv::Point2d> projectToImage(const Vector3d& point_m, const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera) {
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) return std::nullopt;
  const Vector3d p = T_floor_camera.inverse() * point_m;
  constexpr double kNear_m = 0.1;
  if (!(p.z() > kNear_m)) return std::nullopt;
  return cv::Point2d(camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy);
}

cv::Size pictureSize(const AnnotateParams& params) {
  const cv::Size image = imagePanelSize(params);
  return {even(3 * kMargin + image.width + params.plan_width_px),
          even(kHeader + image.height + kFooter)};
}

void annotate(const Scene& scene, const AnnotateParams& params, cv::Mat& picture) {
  const bool fits = (scene.image_bgr.empty() || scene.image_bgr.type() == CV_8UC3) &&
                    (scene.mask.empty() ||
                     (scene.mask.type() == CV_8UC1 && scene.mask.size() == scene.image_bgr.size()));
  if (!fits) throw std::invalid_argument("annotate: the image and the mask do not fit");
  const cv::Size size = pictureSize(params), image = imagePanelSize(params);
  picture.create(size, CV_8UC3);
  picture.setTo(palette::kPaper);
  const cv::Rect image_area(kMargin, kHeader, image.width, image.height);
  const cv::Rect plan_area(image_area.br().x + kMargin, kHeader, params.plan_width_px,
                           image.height);
  const int width = plan_area.br().x - kMargin;
  cv::Mat header = picture(cv::Rect(kMargin, 0, width, kHeader));
  cv::Mat image_panel = picture(image_area);
  cv::Mat plan_panel = picture(plan_area);
  cv::Mat footer = picture(cv::Rect(kMargin, image_area.br().y, width, kFooter));
  drawHeader(scene, header);
  ImagePanel(scene, image_panel);
  drawPlan(scene, params.plan_ahead_m, plan_panel);
  drawFooter(footer);
}

}  // namespace heel
