// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_picture.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace heel {
namespace {

constexpr int kPanelWidth = 230;
constexpr int kPanelHeight = 170;
constexpr int kGap = 14;
constexpr int kTitleHeight = 22;
constexpr int kPanels = 5;
constexpr double kFontScale = 0.42;
const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kFrame(190, 190, 190);
const cv::Scalar kFalsePositive(200, 110, 0);
const cv::Scalar kFalseNegative(0, 80, 210);

void write(cv::Mat& image, const std::string& text, cv::Point place) {
  cv::putText(image, text, place, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kInk, 1, cv::LINE_AA);
}

struct Swatch {
  cv::Vec3b color;
  double share;
  int hue_step;  // order: greys by brightness first, then around the circle of hues
};

/// A histogram's colours on a coarse raster of hue, saturation and value, in the order that they
/// are drawn.
std::vector<Swatch> makeSwatches(const ColorHistogram& colors) {
  constexpr int kHueSteps = 12;
  constexpr int kSteps = 4;
  constexpr int kMinSaturation = 60;
  struct Sum {
    cv::Vec3d color{0, 0, 0};
    double count = 0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>((kHueSteps + 1) * kSteps * kSteps));
  cv::Mat3b pixel(1, 1);
  cv::Mat3b hsv;
  colors.forEach([&](Bgr c, std::uint64_t n) {
    pixel(0, 0) = {c.b, c.g, c.r};
    cv::cvtColor(pixel, hsv, cv::COLOR_BGR2HSV);
    const cv::Vec3b h = hsv(0, 0);
    const int hue = h[1] < kMinSaturation ? 0 : 1 + h[0] * kHueSteps / 180;
    const int bin = (hue * kSteps + h[2] * kSteps / 256) * kSteps + h[1] * kSteps / 256;
    Sum& sum = sums[static_cast<std::size_t>(bin)];
    const auto count = static_cast<double>(n);
    sum.color += count * cv::Vec3d(c.b, c.g, c.r);
    sum.count += count;
  });
  std::vector<Swatch> swatches;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count <= 0) continue;
    swatches.push_back({cv::Vec3b(sums[i].color / sums[i].count),
                        sums[i].count / static_cast<double>(colors.total()),
                        static_cast<int>(i) / (kSteps * kSteps)});
  }
  return swatches;
}

/// Columns for hues, their widths and the heights of their swatches as the shares.
void drawColors(cv::Mat panel, const ColorHistogram& colors) {
  const auto swatches = makeSwatches(colors);
  double left = 0.0;
  for (std::size_t i = 0; i < swatches.size();) {
    std::size_t end = i;
    double width = 0.0;
    while (end < swatches.size() && swatches[end].hue_step == swatches[i].hue_step) {
      width += swatches[end++].share;
    }
    double top = 0.0;
    for (; i < end; ++i) {
      const double height = swatches[i].share / width;
      const cv::Point from(cvRound(left * panel.cols), cvRound(top * panel.rows));
      const cv::Point to(cvRound((left + width) * panel.cols),
                         cvRound((top + height) * panel.rows));
      if (to.x > from.x && to.y > from.y) {
        panel(cv::Rect(from, to)).setTo(cv::Scalar(swatches[i].color));
      }
      top += height;
    }
    left += width;
  }
}

/// Pale, dull and vivid colours beside each other; in each, hue along x and value along y. Colours
/// that do not pass are paper.
void drawPassing(cv::Mat panel, const ColorTable& table) {
  constexpr std::array<uchar, 3> kSaturations = {30, 110, 220};
  cv::Mat3b hsv(panel.size());
  for (int v = 0; v < hsv.rows; ++v) {
    for (int u = 0; u < hsv.cols; ++u) {
      const int third = u * 3 / hsv.cols;
      const int hue = (u * 3 - third * hsv.cols) * 180 / hsv.cols;
      hsv(v, u) = {static_cast<uchar>(hue), kSaturations[static_cast<std::size_t>(third)],
                   static_cast<uchar>(255 - v * 255 / hsv.rows)};
    }
  }
  cv::Mat3b bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  for (int v = 0; v < bgr.rows; ++v) {
    for (int u = 0; u < bgr.cols; ++u) {
      const cv::Vec3b c = bgr(v, u);
      if (table.passes(c[0], c[1], c[2])) panel.at<cv::Vec3b>(v, u) = c;
    }
  }
  for (const int third : {1, 2}) {
    panel.col(third * panel.cols / 3).setTo(kFrame);
  }
}

/// D_H above, D_V below, as bars in their own colours.
void drawDistributions(cv::Mat panel, const ColorHistogram& person) {
  constexpr int kHueBins = 36;
  constexpr int kValueBins = 32;
  std::array<double, kHueBins> hues{};
  std::array<double, kValueBins> values{};
  cv::Mat3b pixel(1, 1);
  cv::Mat3b hsv;
  person.forEach([&](Bgr c, std::uint64_t n) {
    pixel(0, 0) = {c.b, c.g, c.r};
    cv::cvtColor(pixel, hsv, cv::COLOR_BGR2HSV);
    const double share = static_cast<double>(n) / static_cast<double>(person.total());
    hues[static_cast<std::size_t>(hsv(0, 0)[0] * kHueBins / 180)] += share;
    values[static_cast<std::size_t>(hsv(0, 0)[2] * kValueBins / 256)] += share;
  });
  const auto bars = [&](cv::Mat area, const auto& shares, const auto& colorOf) {
    const double most = *std::max_element(shares.begin(), shares.end());
    const int bins = static_cast<int>(shares.size());
    for (int i = 0; i < bins; ++i) {
      const int height = cvRound(shares[static_cast<std::size_t>(i)] / most * (area.rows - 2));
      const int left = i * area.cols / bins;
      const int width = (i + 1) * area.cols / bins - left - 1;
      cv::rectangle(area, cv::Rect(left, area.rows - height, width, height), colorOf(i),
                    cv::FILLED);
    }
  };
  const int half = panel.rows / 2;
  bars(panel.rowRange(0, half - 4), hues, [&](int i) {
    pixel(0, 0) = {static_cast<uchar>(i * 180 / kHueBins), 200, 220};
    cv::cvtColor(pixel, hsv, cv::COLOR_HSV2BGR);
    return cv::Scalar(hsv(0, 0));
  });
  bars(panel.rowRange(half, panel.rows), values,
       [&](int i) { return cv::Scalar::all(i * 220.0 / kValueBins); });
}

void drawErrors(cv::Mat panel, const AppearanceBand& band) {
  const ErrorCurve& curve = band.error_curve;
  const auto place = [&](std::size_t threshold, double share) {
    return cv::Point(static_cast<int>(threshold) * (panel.cols - 1) / 255,
                     cvRound((1.0 - share) * (panel.rows - 1)));
  };
  cv::line(panel, place(band.table.threshold(), 0), place(band.table.threshold(), 1), kFrame, 2);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    cv::line(panel, place(i - 1, curve[i - 1].false_positive_share),
             place(i, curve[i].false_positive_share), kFalsePositive, 2, cv::LINE_AA);
    cv::line(panel, place(i - 1, curve[i - 1].false_negative_share),
             place(i, curve[i].false_negative_share), kFalseNegative, 2, cv::LINE_AA);
  }
}

std::string describe(const AppearanceBand& band) {
  char text[200];
  std::snprintf(text, sizeof text,
                "%.2f to %.2f m, %llu points, threshold %.3g: loses %.0f %%, room passes %.0f %%",
                band.body.min_height_m, band.body.max_height_m,
                static_cast<unsigned long long>(band.person.total()), band.delta(),
                100 * band.errors().false_negative_share, 100 * band.errors().false_positive_share);
  return band.body.name + ", " + text;
}

}  // namespace

cv::Mat drawAppearance(const AppearanceModel& model) {
  const int row_height = 2 * kTitleHeight + kPanelHeight + kGap;
  cv::Mat picture(static_cast<int>(model.bands().size()) * row_height + kGap,
                  kPanels * (kPanelWidth + kGap) + kGap, CV_8UC3, kPaper);
  int top = kGap;
  for (const AppearanceBand& band : model.bands()) {
    write(picture, describe(band), {kGap, top + 12});
    const auto panel = [&](int i, const char* title) {
      const cv::Rect area(kGap + i * (kPanelWidth + kGap), top + 2 * kTitleHeight, kPanelWidth,
                          kPanelHeight);
      write(picture, title, {area.x, area.y - 8});
      cv::rectangle(picture, cv::Rect(area.x - 1, area.y - 1, area.width + 2, area.height + 2),
                    kFrame);
      return picture(area);
    };
    if (!band.table.empty()) {
      drawColors(panel(0, "the person's colours"), band.person);
      drawColors(panel(1, "the room's colours"), model.room());
      drawPassing(panel(2, "passes: pale, dull, vivid"), band.table);
      drawDistributions(panel(3, "hue and value (D_H, D_V)"), band.person);
      drawErrors(panel(4, "errors: room blue, person red"), band);
    }
    top += row_height;
  }
  return picture;
}

}  // namespace heel
