// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pictures/map_picture.hpp>

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

}  // namespace heel
