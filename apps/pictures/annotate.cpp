// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/picture_parts.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {

namespace {

constexpr int kPlanWidth = 440;
constexpr double kImageAspect = 4.0 / 3.0;  // Width by height of the image's panel.
constexpr int kMargin = 12;
constexpr int kHeader = 44;
constexpr int kFooter = 30;

int even(int pixels) { return pixels + pixels % 2; }

cv::Size imagePanelSize(const AnnotateParams& params) {
  return {static_cast<int>(std::lround(params.panel_height_px * kImageAspect)),
          params.panel_height_px};
}

/// What the marks mean.
const std::vector<LegendEntry> kLegend = {
    {"target", palette::kTarget},
    {"other tracks", palette::kTrack},
    {"predicted, not seen", palette::kTrack, LegendEntry::Mark::kRing},
    {"candidate", palette::kBlob, LegendEntry::Mark::kRing},
    {"candidate thrown out", palette::kGatedOut, LegendEntry::Mark::kRing},
    {"the target's colours", palette::kBlob, LegendEntry::Mark::kLine}};

std::string timeOf(const DrawnFrame& scene) {
  return "frame " + std::to_string(scene.frame) + "    " + fixedText(scene.stamp_s, 2) + " s";
}

}  // namespace

cv::Size pictureSize(const AnnotateParams& params) {
  const cv::Size image = imagePanelSize(params);
  return {even(3 * kMargin + image.width + kPlanWidth), even(kHeader + image.height + kFooter)};
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
  const cv::Rect plan_area(image_area.br().x + kMargin, kHeader, kPlanWidth, image.height);
  const int width = plan_area.br().x - kMargin;
  cv::Mat header = picture(cv::Rect(kMargin, 0, width, kHeader));
  cv::Mat image_panel = picture(image_area);
  cv::Mat plan_panel = picture(plan_area);
  cv::Mat footer = picture(cv::Rect(kMargin, image_area.br().y, width, kFooter));
  drawHeader(scene.state, scene.tone, scene.reason, timeOf(scene), header);
  drawImage(scene, image_panel);
  drawPlan(scene, kPlanAhead_m, plan_panel);
  drawLegend(kLegend, footer);
}

}  // namespace heel
