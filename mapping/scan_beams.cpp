// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/scan_beams.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kMinRange_m = 0.05;  // Beams that end nearer hit the robot itself, or dust.

}  // namespace

ScanBeams::ScanBeams(const FloorPose& T_base_scanner, const ScanBeamsParams& params)
    : T_base_scanner_(T_base_scanner), params_(params) {
  if (params.beams == 0) throw std::invalid_argument("ScanBeams: no beams");
  if (!(params.max_range_m > kMinRange_m)) {
    throw std::invalid_argument("ScanBeams: max_range_m must be above 0.05 m");
  }
  ends_.reserve(params.beams);
}

const BeamEnds& ScanBeams::choose(const LaserScan& scan, const std::vector<FloorDisc>& leave_out,
                                  const FloorPose& T_base_then) {
  usable_.clear();
  const FloorPose scanner = T_base_then * T_base_scanner_;
  const Eigen::Rotation2Dd step(scan.step_rad);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= kMinRange_m && range_m <= params_.max_range_m)) continue;  // Or NaN.
    const double angle = scan.angle(i);
    const Eigen::Vector2d end =
        scanner * Eigen::Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    const bool masked = std::any_of(leave_out.begin(), leave_out.end(), [&](const FloorDisc& d) {
      return (end - d.center).squaredNorm() <= d.radius_m * d.radius_m;
    });
    if (!masked && end.allFinite()) usable_.push_back(end);
  }
  ends_.clear();
  const std::size_t count = std::min(params_.beams, usable_.size());
  for (std::size_t i = 0; i < count; ++i) {
    ends_.add(usable_[(2 * i + 1) * usable_.size() / (2 * count)]);
  }
  return ends_;
}

double ScanResiduals::fit() const {
  return beams == 0 ? 1.0 : explained / (explained + beyond + kShorterCounts * shorter);
}

ScanResiduals scanResiduals(const LikelihoodField& field, const BeamEnds& ends,
                            const FloorPose& pose, const FloorPose& T_base_scanner, double near_m,
                            BeamEnds* not_shorter) {
  const FloorPose scanner = pose * T_base_scanner;
  int explained = 0, shorter = 0, beyond = 0;
  if (not_shorter != nullptr) not_shorter->clear();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Eigen::Vector2d end =
        pose * Eigen::Vector2d(static_cast<double>(ends.x[i]), static_cast<double>(ends.y[i]));
    const Eigen::Vector2d beam = end - scanner.position;
    const double range_m = beam.norm();
    const double map_m =
        field.castRay(scanner.position, std::atan2(beam.y(), beam.x()), range_m + near_m);
    if (map_m < range_m - near_m) {
      ++beyond;
    } else if (map_m < range_m + near_m || field.distance_m(end) <= near_m) {
      ++explained;
    } else {
      ++shorter;
      continue;
    }
    if (not_shorter == nullptr) continue;
    not_shorter->x.push_back(ends.x[i]);
    not_shorter->y.push_back(ends.y[i]);
  }
  const double all = std::max<double>(1.0, static_cast<double>(ends.size()));
  return {explained / all, shorter / all, beyond / all, static_cast<int>(ends.size())};
}

}  // namespace heel
