// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/picture_parts.hpp>

namespace heel {

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

void drawHeader(const std::string& state, Tone tone, const std::string& reason,
                const std::string& time, cv::Mat& header) {
  const int row = header.rows / 2;
  drawText(header, time, {header.cols, row}, palette::kInkSoft, kTextSize, Align::kRight);
  int column = 0;
  if (!state.empty()) {
    column =
        14 + drawLabel(header, state, {0, row}, colorOf(tone), palette::kPaper, kTextSizeLarge);
  }
  const int room = header.cols - textWidth(time) - 24 - column;
  drawText(header, fittedText(reason, room), {column, row}, palette::kInk);
}

void drawLegend(const std::vector<LegendEntry>& entries, cv::Mat& footer) {
  const int row = footer.rows / 2;
  int column = 6;
  for (const LegendEntry& entry : entries) {
    const cv::Point2d at(column, row);
    switch (entry.mark) {
      case LegendEntry::Mark::kDisc:
        fillCircle(footer, at, 5.0, entry.color);
        break;
      case LegendEntry::Mark::kRing:
        drawCircle(footer, at, 5.0, entry.color);
        break;
      case LegendEntry::Mark::kSquare:
        fillOutline(footer,
                    {at + cv::Point2d(-5, -5), at + cv::Point2d(5, -5), at + cv::Point2d(5, 5),
                     at + cv::Point2d(-5, 5)},
                    entry.color, 0.7);
        break;
      case LegendEntry::Mark::kLine:
        drawLine(footer, at + cv::Point2d(-6, 0), at + cv::Point2d(6, 0), entry.color, 2);
        break;
    }
    drawText(footer, entry.text, {column + 13, row}, palette::kInkSoft, kTextSizeSmall);
    column += 13 + textWidth(entry.text, kTextSizeSmall) + 26;
  }
}

}  // namespace heel
