// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/report/annotate.hpp"

#include "apps/report/csv_file.hpp"
#include "apps/report/drawing.hpp"
#include "apps/report/image_picture.hpp"
#include "apps/report/plan_picture.hpp"

#include <cmath>
#include <stdexcept>

namespace heel {

namespace {

constexpr int kMargin = 12;
constexpr int kHeader = 44;
constexpr int kFooter = 30;

int even(int pixels) { return pixels + pixels % 2; }

cv::Size imagePanelSize(const AnnotateParams& params) {
  return {static_cast<int>(std::lround(params.panel_height_px * params.image_aspect)),
          params.panel_height_px};
}

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

void drawHeader(const DrawnFrame& scene, cv::Mat& header) {
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
}

}  // namespace

cv::Size pictureSize(const AnnotateParams& params) {
  const cv::Size image = imagePanelSize(params);
  return {even(3 * kMargin + image.width + params.plan_width_px),
          even(kHeader + image.height + kFooter)};
}

void annotate(const DrawnFrame& scene, const AnnotateParams& params, cv::Mat& picture) {
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
  drawImage(scene, image_panel);
  drawPlan(scene, params.plan_ahead_m, plan_panel);
  drawFooter(footer);
}

}  // namespace heel
