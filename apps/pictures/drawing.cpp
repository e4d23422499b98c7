// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/drawing.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kFar = 16000.0;
constexpr int kShift = 4;  // bits behind the point that OpenCV's drawing takes

/// Places far off the picture would overflow OpenCV's fixed point.
cv::Point fixedPoint(cv::Point2d p) {
  const auto fixed = [](double v) {
    return static_cast<int>(std::lround(std::clamp(v, -kFar, kFar) * (1 << kShift)));
  };
  return {fixed(p.x), fixed(p.y)};
}

std::vector<cv::Point> fixedPoints(const Outline& outline) {
  std::vector<cv::Point> points(outline.size());
  std::transform(outline.begin(), outline.end(), points.begin(), fixedPoint);
  return points;
}

int capitalHeight(double size) {
  int baseline = 0;
  return cv::getTextSize("H", kFont, size, 1, &baseline).height;
}

/// Draws with `draw(patch, corner)` on a copy of the rectangle, and mixes it in.
template <typename Draw>
void mixIn(cv::Mat& picture, cv::Rect area, double opacity, Draw&& draw) {
  area &= cv::Rect(0, 0, picture.cols, picture.rows);
  if (area.empty()) return;
  cv::Mat patch = picture(area).clone();
  draw(patch, cv::Point2d(area.x, area.y));
  cv::addWeighted(patch, opacity, picture(area), 1.0 - opacity, 0.0, picture(area));
}

cv::Rect around(const Outline& outline) {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (const auto& p : outline) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  const auto pixel = [](double v) { return static_cast<int>(std::clamp(v, -1e5, 1e5)); };
  return {cv::Point(pixel(left) - 2, pixel(top) - 2),
          cv::Point(pixel(right) + 3, pixel(bottom) + 3)};
}

}  // namespace

int textWidth(const std::string& text, double size) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, size, 1, &baseline).width;
}

void drawText(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& color,
              double size, Align align) {
  if (align == Align::kCenter) at.x -= textWidth(text, size) / 2;
  if (align == Align::kRight) at.x -= textWidth(text, size);
  at.y += capitalHeight(size) / 2;
  cv::putText(picture, text, at, kFont, size, color, 1, cv::LINE_AA);
}

int drawLabel(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& fill,
              const cv::Scalar& ink, double size, Align align) {
  const int half = capitalHeight(size) / 2 + 6;  // half of its height, and the radius of its ends
  const int width = textWidth(text, size) + 2 * half;
  if (align == Align::kCenter) at.x -= width / 2;
  if (align == Align::kRight) at.x -= width;
  const cv::Point first(at.x + half, at.y), last(at.x + width - half, at.y);
  cv::line(picture, first, last, fill, 2 * half, cv::LINE_AA);
  drawText(picture, text, first, ink, size);
  return width;
}

std::string fittedText(const std::string& text, int width, double size) {
  if (textWidth(text, size) <= width) return text;
  std::string cut = text;
  while (!cut.empty() && textWidth(cut + "...", size) > width) cut.pop_back();
  while (!cut.empty() && cut.back() == ' ') cut.pop_back();
  return cut.empty() ? cut : cut + "...";
}

void drawLine(cv::Mat& picture, cv::Point2d from, cv::Point2d to, const cv::Scalar& color,
              int thickness) {
  cv::line(picture, fixedPoint(from), fixedPoint(to), color, thickness, cv::LINE_AA, kShift);
}

void drawOutline(cv::Mat& picture, const Outline& outline, bool closed, const cv::Scalar& color,
                 int thickness) {
  if (outline.empty()) return;
  cv::polylines(picture, fixedPoints(outline), closed, color, thickness, cv::LINE_AA, kShift);
}

void drawCircle(cv::Mat& picture, cv::Point2d center, double radius, const cv::Scalar& color,
                int thickness) {
  cv::circle(picture, fixedPoint(center), static_cast<int>(std::lround(radius * (1 << kShift))),
             color, thickness, cv::LINE_AA, kShift);
}

void fillOutline(cv::Mat& picture, const Outline& outline, const cv::Scalar& color,
                 double opacity) {
  if (outline.size() < 3) return;
  mixIn(picture, around(outline), opacity, [&](cv::Mat& patch, cv::Point2d corner) {
    Outline moved = outline;
    for (auto& p : moved) p -= corner;
    cv::fillPoly(patch, std::vector<std::vector<cv::Point>>{fixedPoints(moved)}, color, cv::LINE_AA,
                 kShift);
  });
}

void fillCircle(cv::Mat& picture, cv::Point2d center, double radius, const cv::Scalar& color,
                double opacity) {
  const cv::Point2d r(radius, radius);
  mixIn(picture, around({center - r, center + r}), opacity,
        [&](cv::Mat& patch, cv::Point2d corner) {
          drawCircle(patch, center - corner, radius, color, cv::FILLED);
        });
}

cv::Scalar mixed(const cv::Scalar& from, const cv::Scalar& to, double share) {
  return from * (1.0 - share) + to * share;
}

}  // namespace heel
