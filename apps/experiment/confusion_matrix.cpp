// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/confusion_matrix.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {

double ConfusionMatrix::share(std::size_t model_of, std::size_t person, DetectionRule rule) const {
  const DetectionRun& run = at(model_of, person);
  const int frames = rule == DetectionRule::kFollowed ? run.followed : run.blob;
  return run.frames_in_view == 0 ? 0.0 : static_cast<double>(frames) / run.frames_in_view;
}

bool ConfusionMatrix::detected(std::size_t model_of, std::size_t person, DetectionRule rule,
                               double min_share) const {
  const double found = share(model_of, person, rule);
  return found > 0.0 && found >= min_share;
}

ConfusionCount ConfusionMatrix::count(DetectionRule rule, double min_share,
                                      std::optional<std::size_t> without) const {
  ConfusionCount result;
  for (std::size_t model_of = 0; model_of < size(); ++model_of) {
    for (std::size_t person = 0; person < size(); ++person) {
      if (model_of == without || person == without) continue;
      const bool found = detected(model_of, person, rule, min_share);
      if (model_of == person) {
        result.false_negatives.add(!found);
      } else {
        result.false_positives.add(found);
      }
    }
  }
  return result;
}

Proportion ConfusionMatrix::identified() const {
  Proportion result;
  for (std::size_t person = 0; person < size(); ++person) {
    bool own_is_best = at(person, person).appearance() > 0.0;
    for (std::size_t model_of = 0; model_of < size(); ++model_of) {
      if (model_of == person) continue;
      own_is_best =
          own_is_best && at(person, person).appearance() > at(model_of, person).appearance();
    }
    result.add(own_is_best);
  }
  return result;
}

namespace {

constexpr int kCell = 44;
constexpr int kGap = 2;      // Between cells.
constexpr int kMargin = 28;  // Around panels.
constexpr int kLabels = 86;  // Left of the cells.
constexpr int kHead = 78;    // Title, note and column labels over the cells.
constexpr int kTitle = 50;   // The picture's own.
constexpr std::size_t kColumns = 4;

Outline rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

void drawCell(cv::Mat& picture, cv::Point corner, double share, bool diagonal) {
  const double size = kCell - kGap;
  const cv::Scalar full = diagonal ? palette::kGood : palette::kBad;
  const bool known = std::isfinite(share);
  const cv::Scalar fill =
      known ? mixed(palette::kPanelLit, full, std::clamp(share, 0.0, 1.0)) : palette::kPanel;
  fillOutline(picture, rectangle(corner.x, corner.y, size, size), fill, 1.0);
  if (!known) return;
  const auto percent = std::to_string(std::lround(100.0 * share));
  const bool nothing = share < 0.005;
  drawText(picture, percent, corner + cv::Point((kCell - kGap) / 2, (kCell - kGap) / 2),
           nothing ? palette::kInkSoft : palette::kInk, kTextSizeSmall, Align::kCenter);
}

void drawPanel(cv::Mat& picture, cv::Point corner, const ConfusionPanel& panel) {
  const int width = kLabels + kCell * static_cast<int>(panel.people.size());
  drawText(picture, fittedText(panel.title, width), corner + cv::Point(0, 8), palette::kInk);
  drawText(picture, fittedText(panel.note, width, kTextSizeSmall), corner + cv::Point(0, 30),
           palette::kInkSoft, kTextSizeSmall);
  const cv::Point cells = corner + cv::Point(kLabels, kHead);
  for (std::size_t i = 0; i < panel.people.size(); ++i) {
    const int at = static_cast<int>(i) * kCell;
    drawText(picture, fittedText(panel.people[i], kLabels - 10, kTextSizeSmall),
             cells + cv::Point(-10, at + kCell / 2), palette::kInkSoft, kTextSizeSmall,
             Align::kRight);
    drawText(picture, fittedText(panel.people[i], kCell - 2, kTextSizeSmall),
             cells + cv::Point(at + kCell / 2, -14), palette::kInkSoft, kTextSizeSmall,
             Align::kCenter);
    for (std::size_t j = 0; j < panel.people.size(); ++j) {
      drawCell(picture, cells + cv::Point(static_cast<int>(j) * kCell, at),
               panel.shares[i * panel.people.size() + j], i == j);
    }
  }
}

}  // namespace

cv::Mat drawConfusion(const std::string& title, const std::vector<ConfusionPanel>& panels) {
  std::size_t most = 0;
  for (const ConfusionPanel& panel : panels) {
    if (panel.shares.size() != panel.people.size() * panel.people.size()) {
      throw std::invalid_argument("drawConfusion: '" + panel.title + "' is no square matrix");
    }
    most = std::max(most, panel.people.size());
  }
  const std::size_t columns = std::clamp<std::size_t>(panels.size(), 1, kColumns);
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const int width = kLabels + kCell * static_cast<int>(most) + kMargin;
  const int height = kHead + kCell * static_cast<int>(most) + kMargin;
  const int picture_width = std::max(kMargin + static_cast<int>(columns) * width,
                                     2 * kMargin + textWidth(title, kTextSizeLarge));
  cv::Mat picture(kTitle + kMargin + static_cast<int>(rows) * height, picture_width, CV_8UC3,
                  palette::kPaper);
  drawText(picture, title, {kMargin, kTitle / 2 + 6}, palette::kInk, kTextSizeLarge);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const cv::Point corner(kMargin + static_cast<int>(i % columns) * width,
                           kTitle + kMargin / 2 + static_cast<int>(i / columns) * height);
    drawPanel(picture, corner, panels[i]);
  }
  return picture;
}

}  // namespace heel
