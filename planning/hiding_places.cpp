// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/hiding_places.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kStep_m = 0.05;
constexpr double kSqueezes_m = 0.05;  // A body has room where there is so much less.
constexpr double kTouches = 1e-6;     // Of a beam: the one that passes the edge touches the body.
constexpr double kDeepest_m = 2.0;    // Who is further behind an edge is seen in time.

// The range of the next beam, if what two beams end on goes on straight: on a straight line the
// inverse range changes evenly. Infinite if it leads away.
double nextOnLine(double before_m, double now_m) {
  const double inverse = 2.0 / now_m - 1.0 / before_m;
  return inverse > 0.0 ? std::max(1.0 / inverse, now_m) : std::numeric_limits<double>::infinity();
}

// Whether all beams at a body end before it, but for the one that touches it.
bool isHidden(const LaserScan& scan, const Vector2d& body, double body_m) {
  const double away_m = body.norm();
  const double half = std::asin(body_m / away_m) / std::abs(scan.step_rad) - kTouches;
  const double middle = scan.beamAt(std::atan2(body.y(), body.x()));
  for (double beam = std::ceil(middle - half); beam <= middle + half; ++beam) {
    const std::size_t i = scan.index(beam);
    if (i < scan.ranges_m.size() && scan.ranges_m[i] > away_m) return false;
  }
  return true;
}

}  // namespace

void findHidingPlaces(const LaserScan& scan, const FloorPose& scanner, Clearance clearance,
                      double body_m, std::vector<Vector2d>& places) {
  places.clear();
  const std::vector<float>& ranges_m = scan.ranges_m;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    for (const bool on_left : {false, true}) {  // of this beam, the next one passes the edge
      const double next = on_left == (scan.step_rad > 0.0) ? 1.0 : -1.0;
      const std::size_t inner = scan.index(static_cast<double>(i) - next);
      const std::size_t outer = scan.index(static_cast<double>(i) + next);
      if (outer >= ranges_m.size() || inner >= ranges_m.size()) continue;
      const double near_m = ranges_m[i], far_m = ranges_m[outer];
      if (!(near_m > 0.0)) continue;
      if (!(far_m > nextOnLine(ranges_m[inner], near_m) + 2.0 * body_m)) continue;
      const Eigen::Rotation2Dd along(scan.angle(outer));
      const double last_m = std::min(far_m - body_m, near_m + kDeepest_m);
      for (double away_m = near_m + body_m; away_m < last_m; away_m += kStep_m) {
        const Vector2d body = along * Vector2d(away_m, on_left ? -body_m : body_m);
        const Vector2d place = scanner * body;
        if (clearance(place) < body_m - kSqueezes_m) continue;
        if (isHidden(scan, body, body_m)) places.push_back(place);
        break;
      }
    }
  }
}

}  // namespace heel
