// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/charts.hpp>
#include <heel/apps/pages/html.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kWidth = 1000.0, kHeight = 100.0;  // of a chart's drawing
constexpr double kTolerance = 0.4;

/// The stretches of a curve that hold together.
std::vector<std::vector<Vector2d>> stretches(const std::vector<Vector2d>& points) {
  std::vector<std::vector<Vector2d>> parts(1);
  for (const Vector2d& p : points) {
    if (p.allFinite()) {
      parts.back().push_back(p);
    } else if (!parts.back().empty()) {
      parts.emplace_back();
    }
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

std::string areaUnder(const std::vector<Vector2d>& points) {
  std::string path;
  for (const auto& part : stretches(points)) {
    path +=
        svgPath(part, 1) + "V" + fixedText(kHeight, 0) + "H" + fixedText(part.front().x(), 1) + "Z";
  }
  return path;
}

std::string across(double y, const std::string& of_class) {
  return "<line class=\"" + of_class + "\" x1=\"0\" x2=\"1000\" y1=\"" + fixedText(y, 1) +
         "\" y2=\"" + fixedText(y, 1) + "\"/>";
}

/// The top of a scale that is a whole number of steps.
double topOf(double highest, const ChartParams& params) {
  const double wanted = std::clamp(1.05 * highest, params.least_top, params.most_top);
  const double step = niceStep(wanted, 3);
  return std::ceil(wanted / step - 1e-9) * step;
}

}  // namespace

double niceStep(double range, double parts) {
  if (!(range > 0.0) || !std::isfinite(range)) return 1.0;
  const double rough = range / parts;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

TimeScale::TimeScale(const std::vector<FollowSample>& samples) {
  if (samples.empty()) return;
  first_s = samples.front().stamp_s;
  const double last_s = samples.back().stamp_s;
  if (last_s > first_s) duration_s = last_s - first_s;
}

std::string lostTimes(const std::vector<FollowSample>& samples, const TimeScale& scale) {
  std::string rects;
  double lost_s = kNotKnown;
  const auto tint = [&](double until_s) {
    rects += "<rect class=\"lost-time\" x=\"" + fixedText(kWidth * scale.share(lost_s), 1) +
             "\" y=\"0\" width=\"" + fixedText(kWidth * (until_s - lost_s) / scale.duration_s, 1) +
             "\" height=\"100\"/>";
    lost_s = kNotKnown;
  };
  for (const TargetEvent& event : targetEvents(samples)) {
    if (event.is_found) {
      tint(event.stamp_s);
    } else {
      lost_s = event.stamp_s;
    }
  }
  if (std::isfinite(lost_s)) tint(samples.back().stamp_s);
  return rects;
}

std::string timeChart(const std::vector<FollowSample>& samples, const TimeScale& scale,
                      const std::function<double(const FollowSample&)>& value,
                      const ChartParams& params, const std::string& behind) {
  double highest = std::isfinite(params.limit) ? params.limit : 0.0;
  for (const FollowSample& sample : samples) highest = std::fmax(highest, value(sample));
  const double top = topOf(highest, params);
  const auto height = [&](double v) { return kHeight * (1.0 - std::clamp(v / top, 0.0, 1.0)); };

  std::vector<Vector2d> curve;
  for (const FollowSample& sample : samples) {
    const double v = value(sample);
    curve.emplace_back(kWidth * scale.share(sample.stamp_s),
                       std::isfinite(v) ? height(v) : kNotKnown);
  }
  curve = simplified(curve, kTolerance);

  const double step = niceStep(top, 3);
  std::string labels, lines;
  for (int i = 0; i * step <= top + 1e-9; ++i) {
    const double v = i * step;
    labels += "<span style=\"bottom:" + fixedText(100.0 * v / top, 1) + "%\">" +
              fixedText(v, step < 0.1   ? 2
                           : step < 1.0 ? 1
                                        : 0) +
              "</span>";
    if (i > 0) lines += across(height(v), "gridline");
  }
  if (std::isfinite(params.limit)) {
    lines += across(height(params.limit), params.limit_is_bad ? "limit bad" : "limit");
  }
  return "<div class=\"row chart\"><div class=\"name\"><span><b>" + params.title + "</b> [" +
         params.unit + "]</span><span>" + params.limit_text + "</span></div><div class=\"scale\">" +
         labels + "</div><div class=\"plot\"><svg viewBox=\"0 0 1000 100\" " +
         "preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" + params.title +
         " over time\">" + behind + lines + "<path class=\"area " + params.style + "\" d=\"" +
         areaUnder(curve) + "\"/><path class=\"curve " + params.style + "\" d=\"" +
         svgPath(curve, 1) + "\"/></svg></div></div>\n";
}

std::string timeTicks(const TimeScale& scale) {
  std::string ticks;
  const double step_s = niceStep(scale.duration_s, 8);
  for (int i = 0; i * step_s <= scale.duration_s * 0.97; ++i) {
    ticks += "<span style=\"left:" + fixedText(100.0 * i * step_s / scale.duration_s, 2) + "%\">" +
             fixedText(i * step_s, step_s < 1.0 ? 1 : 0) + (i == 0 ? " s" : "") + "</span>";
  }
  return ticks;
}

std::vector<int> binned(const std::vector<double>& values, double first, double step, int bins) {
  std::vector<int> counts(static_cast<std::size_t>(std::max(0, bins)), 0);
  for (const double value : values) {
    const double at = (value - first) / step;
    if (!(at >= 0.0 && at <= bins) || counts.empty()) continue;
    ++counts[std::min(static_cast<std::size_t>(at), counts.size() - 1)];
  }
  return counts;
}

std::string histogram(const std::string& title, const std::string& unit,
                      const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  const std::string head =
      "<figure class=\"histogram\"><figcaption><b>" + title + "</b> [" + unit + "]</figcaption>";
  if (known.empty()) return head + "<p class=\"note\">no values</p></figure>\n";
  std::sort(known.begin(), known.end());
  const double range = known.back() - known.front();
  const double step = niceStep(range > 0.0 ? range : std::max(std::abs(known.back()), 1e-3), 14);
  const double first = std::floor(known.front() / step) * step;
  const int bins = std::max(1, static_cast<int>(std::ceil((known.back() - first) / step + 1e-9)));
  const std::vector<int> counts = binned(known, first, step, bins);
  const int most = *std::max_element(counts.begin(), counts.end());
  const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  const double width = 300.0 / bins;

  std::string bars;
  for (int i = 0; i < bins; ++i) {
    const int count = counts[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    const double height = 96.0 * count / std::max(1, most);
    bars += "<rect x=\"" + fixedText(i * width + 1.0, 1) + "\" y=\"" +
            fixedText(100.0 - height, 1) + "\" width=\"" +
            fixedText(std::max(1.0, width - 2.0), 1) + "\" height=\"" + fixedText(height, 1) +
            "\"><title>" + fixedText(first + i * step, decimals) + " to " +
            fixedText(first + (i + 1) * step, decimals) + " " + unit + ": " +
            std::to_string(count) + "</title></rect>";
  }
  const double middle = known[known.size() / 2];
  return head + "<svg viewBox=\"0 0 300 100\" role=\"img\" aria-label=\"Histogram: " + title +
         "\">" + bars + "<path d=\"M0 100H300\"/></svg><div class=\"ends\"><span>" +
         fixedText(first, decimals) + "</span><span>median " + fixedText(middle, decimals + 1) +
         "</span><span>" + fixedText(first + bins * step, decimals) + "</span></div></figure>\n";
}

}  // namespace heel
