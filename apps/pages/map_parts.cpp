// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pictures/map_picture.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

namespace {

using Eigen::Vector2d;

/// Lines of whole metres, wider apart on a large map.
std::string lattice(const MapFrame& frame) {
  const Vector2d size = frame.size(), corner = frame.topLeft();
  const double step = frame.step_m();
  std::string path;
  for (double x = std::ceil(corner.x() / step) * step; x < corner.x() + size.x(); x += step) {
    path += "M" + svgPlace({x - corner.x(), 0.0}) + "V" + fixedText(size.y(), 2);
  }
  for (double y = std::floor(corner.y() / step) * step; y > corner.y() - size.y(); y -= step) {
    path += "M" + svgPlace({0.0, corner.y() - y}) + "H" + fixedText(size.x(), 2);
  }
  return svgShape("lattice", path);
}

}  // namespace

double niceStep(double range, double parts) {
  if (!(range > 0.0) || !std::isfinite(range)) return 1.0;
  const double rough = range / parts;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

MapFrame::MapFrame(const Eigen::AlignedBox2d& bounds_m) : bounds_(bounds_m) {
  constexpr double kMargin_m = 0.25;
  if (bounds_.isEmpty()) bounds_ = {Vector2d(-1.0, -1.0), Vector2d(1.0, 1.0)};
  bounds_.min() -= Vector2d::Constant(kMargin_m);
  bounds_.max() += Vector2d::Constant(kMargin_m);
}

std::string svgPlace(const Vector2d& at) {
  return fixedText(at.x(), 2) + " " + fixedText(at.y(), 2);
}

std::string svgShape(const std::string& of_class, const std::string& path) {
  return path.empty() ? path : "<path class=\"" + of_class + "\" d=\"" + path + "\"/>\n";
}

std::string svgSquare(const Vector2d& at, double half) {
  const auto corner = [&](double x, double y) { return svgPlace(at + half * Vector2d(x, y)); };
  return "M" + corner(-1, -1) + "L" + corner(1, -1) + "L" + corner(1, 1) + "L" + corner(-1, 1) +
         "Z";
}

std::string svgMap(const MapFrame& frame, const std::string& what) {
  return "<svg viewBox=\"0 0 " + svgPlace(frame.size()) + "\" role=\"img\" aria-label=\"" + what +
         "\">\n" + lattice(frame);
}

std::string svgWalls(const OccupancyGrid& map, const MapFrame& frame) {
  if (map.empty()) return {};
  return svgShape("nobody-knows", outlinePath(map, Occupancy::kUnknown, frame.topLeft())) +
         svgShape("walls", outlinePath(map, Occupancy::kOccupied, frame.topLeft()));
}

std::string legendItem(const std::string& drawing, const std::string& text) {
  return "<li><svg viewBox=\"0 0 26 14\" aria-hidden=\"true\">" + drawing + "</svg>" + text +
         "</li>\n";
}

std::string legendLine(const std::string& tone, const std::string& dashes,
                       const std::string& text) {
  return legendItem("<path stroke=\"var(" + tone + ")\" stroke-dasharray=\"" + dashes +
                        "\" stroke-width=\"2.4\" fill=\"none\" d=\"M0 7H26\"/>",
                    text);
}

namespace {

constexpr double kPathTolerance_m = 0.015;
constexpr double kSlots = 24.0;  ///< About so many moments are marked on both paths.

const Vector2d kNowhere(kNotKnown, kNotKnown);

/// The path of somebody; absent stretches break it.
template <typename PlaceOf>
std::string pathOf(const FollowLog& log, const MapFrame& frame, PlaceOf&& place_of) {
  std::vector<Vector2d> points;
  for (const FollowSample& sample : log.samples) {
    const std::optional<Vector2d> at = place_of(sample);
    points.push_back(at ? frame(*at) : kNowhere);
  }
  return svgPath(simplified(points, kPathTolerance_m));
}

/// A diamond of this half width.
std::string diamondAt(const Vector2d& at, double half) {
  const auto corner = [&](double x, double y) { return svgPlace(at + half * Vector2d(x, y)); };
  return "M" + corner(0, -1) + "L" + corner(1, 0) + "L" + corner(0, 1) + "L" + corner(-1, 0) + "Z";
}

std::size_t mostOthers(const FollowLog& log) {
  std::size_t most = 0;
  for (const FollowSample& sample : log.samples) most = std::max(most, sample.others_true.size());
  return most;
}

/// As in the paper's figure: squares where the robot was, diamonds where it took the person to be
/// at the same time, and what joins them.
std::string slots(const FollowLog& log, const MapFrame& frame) {
  if (log.samples.empty()) return {};
  const double first_s = log.samples.front().stamp_s, last_s = log.samples.back().stamp_s;
  const double step_s = niceStep(last_s - first_s, kSlots);
  std::string joins, squares, diamonds;
  double next_s = first_s;
  Vector2d marked = kNowhere;
  for (const FollowSample& sample : log.samples) {
    if (sample.stamp_s < next_s || !sample.robot_true.position.allFinite()) continue;
    next_s = first_s + (std::floor((sample.stamp_s - first_s) / step_s + 1e-9) + 1.0) * step_s;
    if (!sample.target_estimate) continue;
    const Vector2d robot = frame(sample.robot_true.position),
                   target = frame(*sample.target_estimate);
    if (!target.allFinite() || (robot - marked).norm() < 0.2 * frame.markScale()) continue;
    marked = robot;
    joins += "M" + svgPlace(robot) + "L" + svgPlace(target);
    squares += svgSquare(robot, 0.05 * frame.markScale());
    diamonds += diamondAt(target, 0.08 * frame.markScale());
  }
  return svgShape("slots", joins) + svgShape("squares", squares) + svgShape("diamonds", diamonds);
}

std::string eventMarks(const FollowLog& log, const MapFrame& frame) {
  if (log.samples.empty()) return {};
  std::string marks;
  for (const TargetEvent& event : targetEvents(log.samples)) {
    if (!event.place_m.allFinite()) continue;
    marks +=
        "<g class=\"mark " + std::string(event.is_found ? "found" : "lost") +
        "\" transform=\"translate(" + svgPlace(frame(event.place_m)) + ") scale(" +
        fixedText(frame.markScale(), 2) + ")\"><title>" +
        (event.is_found ? "found again after " : "lost after ") +
        fixedText(event.stamp_s - log.samples.front().stamp_s, 1) +
        " s</title><circle class=\"disc\" r=\".15\"/><path d=\"" +
        (event.is_found ? "M-.07 0L-.02 .06L.07 -.06" : "M-.06 -.06L.06 .06M-.06 .06L.06 -.06") +
        "\"/></g>\n";
  }
  return marks;
}

/// A disc where a path begins, a square where it ends.
template <typename PlaceOf>
std::string terminals(const FollowLog& log, const MapFrame& frame, const std::string& of_class,
                      const std::string& who, PlaceOf&& place_of) {
  std::optional<Vector2d> first, last;
  for (const FollowSample& sample : log.samples) {
    const std::optional<Vector2d> at = place_of(sample);
    if (!at || !at->allFinite()) continue;
    if (!first) first = frame(*at);
    last = frame(*at);
  }
  if (!first) return {};
  const double half = 0.11 * frame.markScale();
  return "<circle class=\"" + of_class + "\" cx=\"" + fixedText(first->x(), 2) + "\" cy=\"" +
         fixedText(first->y(), 2) + "\" r=\"" + fixedText(half, 2) + "\"><title>start of " + who +
         "</title></circle>\n<path class=\"" + of_class + "\" d=\"" + svgSquare(*last, 0.9 * half) +
         "\"><title>end of " + who + "</title></path>\n";
}

/// What the page's script moves.
std::string movingMarks(const FollowLog& log) {
  std::string marks;
  for (std::size_t i = 0; i < mostOthers(log); ++i) {
    marks += "<circle id=\"now-other-" + std::to_string(i) +
             "\" class=\"now-other\" r=\".22\" visibility=\"hidden\"/>\n";
  }
  const DriveLimits& body = log.drive;
  const double along_m = body.front_m - body.back_m + 2.0 * body.radius_m;
  const auto size = [](double size_m) { return fixedText(size_m, 3); };
  marks +=
      "<circle id=\"now-estimate\" class=\"now-estimate\" r=\".32\" visibility=\"hidden\"/>\n"
      "<circle id=\"now-person\" class=\"now-person\" r=\".22\" visibility=\"hidden\"/>\n"
      "<g id=\"now-robot\" visibility=\"hidden\"><rect class=\"now-robot\" x=\"" +
      size(body.back_m - body.radius_m) + "\" y=\"" + size(-body.radius_m) + "\" width=\"" +
      size(along_m) + "\" height=\"" + size(2.0 * body.radius_m) + "\" rx=\"" +
      size(body.radius_m) + "\"/><line class=\"now-nose\" x1=\"0\" y1=\"0\" x2=\"" +
      size(body.front_m + body.radius_m) + "\" y2=\"0\"/></g>\n";
  return marks;
}

std::optional<Vector2d> robotOf(const FollowSample& sample) { return sample.robot_true.position; }
std::optional<Vector2d> personOf(const FollowSample& sample) { return sample.person_true; }

}  // namespace

MapFrame followFrame(const FollowLog& log) {
  Eigen::AlignedBox2d bounds = occupiedBounds(log.map);
  for (const FollowSample& sample : log.samples) {
    for (const auto& at : {robotOf(sample), personOf(sample)}) {
      if (at && at->allFinite()) bounds.extend(*at);
    }
  }
  return MapFrame(bounds);
}

std::string followMap(const FollowLog& log, const MapFrame& frame) {
  std::string svg =
      svgMap(frame, "Map seen from above with the paths of the robot and of the person");
  svg += svgWalls(log.map, frame);
  for (std::size_t i = 0; i < mostOthers(log); ++i) {
    svg += svgShape("other-path", pathOf(log, frame, [i](const FollowSample& sample) {
                      return i < sample.others_true.size()
                                 ? std::optional<Vector2d>(sample.others_true[i])
                                 : std::nullopt;
                    }));
  }
  svg += svgShape("person-path", pathOf(log, frame, personOf));
  svg += svgShape("robot-path", pathOf(log, frame, robotOf));
  svg += slots(log, frame);
  svg += terminals(log, frame, "terminal person", "the person's way", personOf);
  svg += terminals(log, frame, "terminal", "the robot's way", robotOf);
  svg += eventMarks(log, frame);
  return svg + movingMarks(log) + "</svg>";
}

std::string followMapLegend(const FollowLog& log) {
  std::string items =
      legendLine("--robot", "none", "robot") +
      legendLine("--person", "6 4",
                 log.person.empty() ? "person" : "person: " + escapedHtml(log.person));
  if (mostOthers(log) > 0) items += legendLine("--other", "1 4", "other people");
  items += legendItem(
      "<circle cx=\"7\" cy=\"7\" r=\"5\" fill=\"var(--soft)\"/><path fill=\"var(--soft)\" "
      "d=\"M16 2h10v10h-10Z\"/>",
      "start, end");
  items += legendItem(
      "<path stroke=\"var(--soft)\" d=\"M5 7H20\"/><path stroke=\"var(--robot)\" "
      "fill=\"var(--card)\" d=\"M1 3h8v8h-8Z\"/><path stroke=\"var(--person)\" "
      "fill=\"var(--card)\" d=\"M20 2l5 5l-5 5l-5 -5Z\"/>",
      "where the robot took the person to be");
  const auto events = targetEvents(log.samples);
  if (!events.empty()) {
    items += legendItem(
        "<g fill=\"none\" stroke-width=\"2\"><circle stroke=\"var(--bad)\" cx=\"7\" cy=\"7\" "
        "r=\"6\"/><path stroke=\"var(--bad)\" d=\"M4 4l6 6M4 10l6 -6\"/><circle "
        "stroke=\"var(--good)\" cx=\"20\" cy=\"7\" r=\"6\"/><path stroke=\"var(--good)\" "
        "d=\"M17 7l2 3l4 -5\"/></g>",
        "lost, found");
  }
  return items;
}

void addFollowMarks(const FollowLog& log, const MapFrame& frame, RunMoments& moments) {
  const auto add = [&](const std::string& id, auto&& place_of, const RunMoments::Number& turn) {
    moments.addMark(
        id,
        [&](std::size_t i) {
          const std::optional<Vector2d> at = place_of(log.samples[i]);
          return at ? std::optional<Vector2d>(frame(*at)) : std::nullopt;
        },
        turn);
  };
  add("now-robot", robotOf, [&](std::size_t i) { return log.samples[i].robot_true.yaw_rad; });
  add("now-person", personOf, nullptr);
  add(
      "now-estimate", [](const FollowSample& s) { return s.target_estimate; }, nullptr);
  for (std::size_t k = 0; k < mostOthers(log); ++k) {
    add(
        "now-other-" + std::to_string(k),
        [k](const FollowSample& s) {
          return k < s.others_true.size() ? std::optional<Vector2d>(s.others_true[k])
                                          : std::nullopt;
        },
        nullptr);
  }
}

}  // namespace heel
