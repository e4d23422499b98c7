// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/plan_net_picture.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace heel {

namespace {

using Eigen::Vector2d;

constexpr double kScale = 1.35;       // pixels for a unit of the layout
constexpr double kRadius = 25.0;      // of a place
constexpr double kBarLength = 36.0;   // of a transition
constexpr double kBarGap = 5.0;       // from the middle of a bar to the end of an arrow
constexpr int kLine = 18;             // from one line of text to the next
constexpr double kNetMargin = 150.0;  // around the outermost node: room for its label
constexpr double kTitle = 50.0;

cv::Point2d point(const Vector2d& v) { return {v.x(), v.y()}; }
cv::Point pixel(const Vector2d& v) {
  return {static_cast<int>(std::lround(v.x())), static_cast<int>(std::lround(v.y()))};
}

cv::Scalar colorOf(const PlaceRole& role) {
  if (role.goal_tokens >= 0) return palette::kGood;
  if (role.fail_tokens >= 0) return palette::kBad;
  return role.action >= 0 ? palette::kTrack : palette::kInkSoft;
}

/// A transition's name, word by word, the guard last.
std::vector<std::string> linesOf(const PetriTransition& transition, const PlanGuard& guard) {
  std::vector<std::string> lines;
  std::istringstream words(transition.name.substr(0, transition.name.find('[')));
  for (std::string word; words >> word;) lines.push_back(word);
  if (!guard.text().empty()) lines.push_back("[" + guard.text() + "]");
  return lines;
}

/// Draws one net at its places in the picture.
class NetPicture {
 public:
  explicit NetPicture(const PetriPlan& plan) : plan_(plan), layout_(layoutNet(plan.net)) {
    Vector2d low = layout_.places.front(), high = low;
    for (const auto* nodes : {&layout_.places, &layout_.transitions}) {
      for (const Vector2d& at : *nodes) {
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
      }
    }
    origin_ = kScale * low - Vector2d(kNetMargin, kNetMargin / 2 + kTitle);
    const Vector2d size = kScale * high - origin_ + Vector2d(kNetMargin, kNetMargin / 2 + 20.0);
    picture_.create(static_cast<int>(size.y()), static_cast<int>(size.x()), CV_8UC3);
    picture_.setTo(palette::kPaper);
    for (Vector2d& at : layout_.places) at = inPicture(at);
    for (Vector2d& at : layout_.transitions) at = inPicture(at);
  }

  cv::Mat draw(const std::string& summary) {
    for (std::size_t t = 0; t < plan_.transitions.size(); ++t) drawArcs(t);
    for (std::size_t p = 0; p < plan_.places.size(); ++p) drawPlace(p);
    for (std::size_t t = 0; t < plan_.transitions.size(); ++t) drawTransition(t);
    drawText(picture_, plan_.net.name, {24, 28}, palette::kInk, kTextSizeLarge);
    drawText(picture_, summary, {24, 52}, palette::kInkSoft, kTextSize);
    return picture_;
  }

 private:
  Vector2d inPicture(const Vector2d& at) const { return kScale * at - origin_; }

  const Vector2d& at(const PetriArc& arc) const {
    return layout_.places[static_cast<std::size_t>(arc.place)];
  }

  /// The way that tokens go through a transition; of length 1.
  Vector2d flowThrough(std::size_t t) const {
    const PetriTransition& transition = plan_.net.transitions[t];
    Vector2d flow = Vector2d::Zero();
    for (const PetriArc& arc : transition.takes) {
      const Vector2d from = arc.bends.empty() ? at(arc) : inPicture(arc.bends.back());
      flow += (layout_.transitions[t] - from).normalized();
    }
    for (const PetriArc& arc : transition.gives) {
      const Vector2d to = arc.bends.empty() ? at(arc) : inPicture(arc.bends.front());
      flow += (to - layout_.transitions[t]).normalized();
    }
    return flow.norm() > 0.1 ? flow.normalized() : Vector2d(1.0, 0.0);
  }

  /// From a place to a bar, which it reaches at a right angle.
  std::vector<Vector2d> curve(const PetriArc& arc, std::size_t t, const Vector2d& flow) const {
    const Vector2d bar = layout_.transitions[t] - kBarGap * flow;
    std::vector<Vector2d> line{at(arc)};
    if (!arc.bends.empty()) {
      for (const Vector2d& bend : arc.bends) line.push_back(inPicture(bend));
      line.push_back(bar);
      return line;
    }
    const Vector2d control = bar - 0.45 * (bar - at(arc)).norm() * flow;
    constexpr int kPieces = 24;
    for (int i = 1; i <= kPieces; ++i) {
      const double s = static_cast<double>(i) / kPieces;
      line.push_back((1 - s) * (1 - s) * at(arc) + 2 * s * (1 - s) * control + s * s * bar);
    }
    return line;
  }

  void drawArrow(const std::vector<Vector2d>& line, const cv::Scalar& color) {
    Outline outline;
    for (const Vector2d& p : line) outline.push_back(point(p));
    drawOutline(picture_, outline, false, color, 1);
    const Vector2d tip = line.back();
    const Vector2d along = (tip - line[line.size() - 2]).normalized();
    const Vector2d aside(-along.y(), along.x());
    fillOutline(picture_,
                {point(tip), point(tip - 10.0 * along + 4.5 * aside),
                 point(tip - 10.0 * along - 4.5 * aside)},
                color, 1.0);
  }

  /// Cuts off what is in a place's circle; the line begins there.
  static void leaveCircle(std::vector<Vector2d>& line, double radius) {
    const Vector2d middle = line.front();
    while (line.size() > 2 && (line[1] - middle).norm() < radius) line.erase(line.begin());
    const Vector2d out = line[1] - middle;
    line.front() = middle + radius * out.normalized();
  }

  void drawArcs(std::size_t t) {
    const PetriTransition& transition = plan_.net.transitions[t];
    const Vector2d flow = flowThrough(t);
    for (const PetriArc& arc : transition.takes) {
      std::vector<Vector2d> line = curve(arc, t, flow);
      leaveCircle(line, kRadius);
      drawArrow(line, palette::kInkSoft);
      drawWeight(arc, line);
    }
    for (PetriArc arc : transition.gives) {
      std::reverse(arc.bends.begin(), arc.bends.end());
      std::vector<Vector2d> line = curve(arc, t, -flow);
      leaveCircle(line, kRadius + 2.0);
      std::reverse(line.begin(), line.end());
      drawArrow(line, palette::kInkSoft);
      drawWeight(arc, line);
    }
  }

  void drawWeight(const PetriArc& arc, const std::vector<Vector2d>& line) {
    if (arc.weight == 1) return;
    drawLabel(picture_, std::to_string(arc.weight), pixel(line[line.size() / 2]), palette::kPanel,
              palette::kInk, kTextSizeSmall, Align::kCenter);
  }

  /// A line of a label, centred; arcs that pass below it are dimmed.
  void writeLine(const std::string& text, const Vector2d& at, const cv::Scalar& color,
                 double size) {
    const double half = 0.5 * textWidth(text, size) + 3.0, height = 0.5 * kLine;
    fillOutline(picture_,
                {{at.x() - half, at.y() - height},
                 {at.x() + half, at.y() - height},
                 {at.x() + half, at.y() + height},
                 {at.x() - half, at.y() + height}},
                palette::kPaper, 0.8);
    drawText(picture_, text, pixel(at), color, size, Align::kCenter);
  }

  void drawPlace(std::size_t p) {
    const PetriPlace& place = plan_.net.places[p];
    const PlaceRole& role = plan_.places[p];
    const Vector2d middle = layout_.places[p];
    const cv::Scalar color = colorOf(role);
    fillCircle(picture_, point(middle), kRadius, mixed(palette::kPanel, color, 0.22));
    drawCircle(picture_, point(middle), kRadius, color, 2);
    if (role.goal_tokens >= 0 || role.fail_tokens >= 0) {
      drawCircle(picture_, point(middle), kRadius - 5.0, color, 1);
    }
    if (place.tokens == 1) {
      fillCircle(picture_, point(middle), 6.0, palette::kInk);
    } else if (place.tokens > 1) {
      drawText(picture_, std::to_string(place.tokens), pixel(middle), palette::kInk, kTextSize,
               Align::kCenter);
    }
    const Vector2d label = middle + Vector2d(0.0, kRadius + 15.0) + place.graphics.label_offset;
    writeLine(place.name, label, palette::kInk, kTextSize);
  }

  void drawTransition(std::size_t t) {
    const PetriTransition& transition = plan_.net.transitions[t];
    const Vector2d flow = flowThrough(t);
    const Vector2d aside = 0.5 * kBarLength * Vector2d(-flow.y(), flow.x());
    const Vector2d middle = layout_.transitions[t];
    drawLine(picture_, point(middle - aside), point(middle + aside), palette::kInk, 5);
    const std::vector<std::string> lines = linesOf(transition, plan_.transitions[t].guard);
    const double below = std::abs(aside.y()) + 16.0;
    Vector2d at = middle + Vector2d(0.0, below) + transition.graphics.label_offset;
    for (const std::string& line : lines) {
      const bool is_guard = line.front() == '[';
      writeLine(line, at, is_guard ? palette::kWarning : palette::kInkSoft,
                is_guard ? kTextSize : kTextSizeSmall);
      at.y() += kLine;
    }
  }

  const PetriPlan& plan_;
  NetLayout layout_;
  Vector2d origin_ = Vector2d::Zero();
  cv::Mat picture_;
};

}  // namespace

cv::Mat drawPlanNet(const PetriPlan& plan, const std::string& summary) {
  return NetPicture(plan).draw(summary);
}

}  // namespace heel
